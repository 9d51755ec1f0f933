// Scenes through the program: what it writes is the databases' scenes in every digit, at any size.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "program.h"
#include "scenes/io/load_scene.h"
#include "scenes/tests/spd_reference.h"

namespace rayshoot::test {
namespace {

/// "balls/s2/t" is "balls:2/patches" to the program.
std::string spec_of(const std::string& key) {
  const auto first = key.find('/'), second = key.find('/', first + 1);
  return fmt::format("{}:{}/{}", key.substr(0, first), key.substr(first + 2, second - first - 2),
                     key.ends_with("/c") ? "curves" : "patches");
}

/// Test names have letters and digits alone.
std::string as_name(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return text;
}

/// Export a scene and call `look` with the file.
void with_exported(std::vector<std::string> arguments, const auto& look) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "scene.nff";
  arguments.insert(arguments.begin(), "scene");
  arguments.insert(arguments.end(), {"--export", file.string()});
  const Outcome outcome = run_program(arguments, folder.path());
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_EQ(outcome.output + outcome.errors, "");
  look(file);
}

class ExportedScene : public ::testing::TestWithParam<std::string> {};

TEST_P(ExportedScene, ReadsBackToTheOriginalPrograms) {
  with_exported({spec_of(GetParam()), "--precision", "17"}, [](const std::filesystem::path& file) {
    const Scene scene = load_scene(file.string()).scene;
    expect_reference(GetParam(), aggregates_of(scene));
    EXPECT_TRUE(same_content(scene, load_scene(spec_of(GetParam())).scene));
  });
}

INSTANTIATE_TEST_SUITE_P(Scenes, ExportedScene, ::testing::ValuesIn(reference_keys()),
                         [](const auto& test) { return as_name(test.param); });

/// How many records of each kind a file must have: spheres, cones and cylinders, flat polygons, patches.
struct Sized {
  std::vector<std::string> arguments;
  std::size_t spheres = 0, cones = 0, polygons = 0, patches = 0;

  friend void PrintTo(const Sized& sized, std::ostream* out) { *out << sized.arguments.front(); }
};

class ExportedSize : public ::testing::TestWithParam<Sized> {};

TEST_P(ExportedSize, HasAsManyRecordsAsTheFormulaSays) {
  with_exported(GetParam().arguments, [](const std::filesystem::path& file) {
    std::map<std::string, std::size_t> records;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) ++records[line.substr(0, line.find(' '))];
    EXPECT_EQ(records["s"], GetParam().spheres);
    EXPECT_EQ(records["c"], GetParam().cones);
    EXPECT_EQ(records["p"], GetParam().polygons);
    EXPECT_EQ(records["pp"], GetParam().patches);
  });
}

constexpr std::size_t power(std::size_t base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// Beyond the sizes for which there is a reference; a sphere becomes 12 R^2 patches, a cone 8 R.
INSTANTIATE_TEST_SUITE_P(
    Scenes, ExportedSize,
    ::testing::Values(Sized{{"balls:5"}, (power(9, 6) - 1) / 8, 0, 1, 0},
                      Sized{{"balls:3/patches", "--tessellation", "1"}, 0, 0, 1, 12 * (power(9, 4) - 1) / 8},
                      Sized{{"gears:5"}, 0, 0, 1 + 146 * 5 * 5 * 5, 0},
                      Sized{{"mount:7"}, 4, 0, 2 * power(4, 7), 0},
                      Sized{{"mount:5/patches", "--tessellation", "5"}, 0, 0, 2 * power(4, 5), 4 * 12 * 25},
                      Sized{{"rings:8"}, 5 * 8 * 9 * 17, 5 * 8 * 9 * 17, 1, 0},
                      Sized{{"teapot:15"}, 0, 0, 15 * 15, 64 * 15 * 15 - 8 * 15},
                      Sized{{"tetra:8"}, 0, 0, power(4, 8), 0},
                      Sized{{"tree:13"}, power(2, 14) - 1, power(2, 14) - 1, 1, 0},
                      Sized{{"tree:6/patches", "--tessellation", "2"}, 0, 0, 1, 127 * (12 * 4 + 8 * 2)},
                      Sized{{"lattice:15"}, 16 * 16 * 16, 3 * 15 * 16 * 16, 0, 0},
                      Sized{{"jacks:4"}, 6 * (power(8, 4) - 1) / 7, 3 * (power(8, 4) - 1) / 7, 0, 0},
                      Sized{{"shells:6"}, 180 * power(2, 6) + 1, 0, 0, 0},
                      Sized{{"sombrero:3"}, 0, 0, 2 * power(127, 2), 0}),
    [](const auto& test) { return as_name(test.param.arguments.front()); });

}  // namespace
}  // namespace rayshoot::test
