#include "scenes/io/nff.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scenes/core/registry.h"
#include "scenes/geometry/polygon.h"

namespace rayshoot {
namespace {

using ::testing::HasSubstr;

const std::string kView =
    "b 0 0 0\nv\nfrom 0 0 -5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 0\nresolution 64 48\n";
const std::string kMaterial = "f 1 1 1 1 0 1 0 1\n";
const std::string kStart = kView + kMaterial;  // nine lines

Scene parse(const std::string& text) {
  std::istringstream in(text);
  return read_nff(in, "test.nff");
}

std::string refusal(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string written(const Scene& scene, int precision) {
  std::ostringstream out;
  write_nff(scene, out, precision);
  return out.str();
}

Scene generated(const SceneGenerator& generator, const SceneOptions& options) {
  SceneBuilder builder(options);
  generator.generate(options, Arguments(generator.parameters, {}, generator.id), builder);
  return std::move(builder).finish();
}

const SceneGenerator* find_generator(const std::string& id) {
  for (const SceneGenerator* generator : scene_generators())
    if (generator->id == id) return generator;
  return nullptr;
}

TEST(ReadNff, UnderstandsEveryRecord) {
  const Scene scene = parse(
      "# a scene\n\nb 0.1 0.2 0.3\nv\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\nangle 30\nhither 0.5\nresolution 64 "
      "48\n"
      "l 4 5 6\nl 7 8 9 0.5 0.25 1\n"
      "f 1 0.75 0.33 0.8 0.1 100 0.2 1.5\n"
      "s 0 1 2 0.5   # a sphere\r\n"
      "p 3\n0 0 0\n1 0 0\n0 1 0\n"
      "f 0 1 0 1 0 1 0 1\n"
      "p 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
      "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 2\n0 1 0 0 0 3\n"
      "c 0 0 0 1 0 0 1 0.5\nc\n0 0 0 1\n0 0 1 0.25\n"
      "  s -1e-3 +.0 2 .5");
  EXPECT_EQ(scene.background, (Vec3d{0.1, 0.2, 0.3}));
  EXPECT_EQ(scene.view, (View{{1, 2, 3}, {0, 0, 0}, {0, 0, 1}, 30, 0.5, 64, 48}));
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0], (Light{{4, 5, 6}, std::nullopt}));
  EXPECT_EQ(scene.lights[1], (Light{{7, 8, 9}, Vec3d{0.5, 0.25, 1}}));
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0], (Material{{1, 0.75, 0.33}, 0.8, 0.1, 100, 0.2, 1.5}));
  EXPECT_EQ(scene.counts(), (ObjectCounts{2, 1, 2, 2, 0}));
  ASSERT_EQ(scene.size(), 7u);
  EXPECT_EQ(scene.objects[0], (SceneObject{ObjectKind::sphere, 0, 0, kNoObject}));
  EXPECT_EQ(scene.objects[1], (SceneObject{ObjectKind::triangle, 0, 0, kNoObject}));
  EXPECT_EQ(scene.objects[2], (SceneObject{ObjectKind::polygon, 0, 1, kNoObject}));
  EXPECT_EQ(scene.objects[3], (SceneObject{ObjectKind::triangle, 1, 1, 0}));
  EXPECT_EQ(scene.vertex_normals[2], (Vec3d{0, 0, 3}));
  EXPECT_EQ(scene.cones[0], (Cone<double>{{0, 0, 0}, 1, {0, 0, 1}, 0.5}));
  EXPECT_EQ(scene.cones[1].apex_radius, 0.25);
  EXPECT_EQ(scene.spheres[1], (Sphere<double>{{-1e-3, 0, 2}, 0.5}));
}

struct Malformed {
  const char* name;
  std::string text;
  std::string message;
};

class RefusedNff : public ::testing::TestWithParam<Malformed> {};

TEST_P(RefusedNff, NamesLineAndReason) {
  EXPECT_EQ(refusal(GetParam().text), "test.nff:" + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    ReadNff, RefusedNff,
    ::testing::Values(
        Malformed{"Empty", "", "0: the file ends without a view (record v)"},
        Malformed{"NoView", "b 0 0 0\n", "1: the file ends without a view (record v)"},
        Malformed{"ObjectBeforeView", kMaterial + "s 0 0 0 1\n", "2: an object before the view (record v)"},
        Malformed{"ObjectBeforeMaterial", kView + "s 0 0 0 1\n",
                  "9: an object before any material (record f)"},
        Malformed{"SecondView", kView + kView.substr(8), "9: a second view"},
        Malformed{"SecondBackground", kView + "b 0 0 0\n", "9: a second background"},
        Malformed{"ViewOutOfOrder", "v\nat 0 0 0\n", "2: the view needs 'from' here"},
        Malformed{"ViewCutShort", "v\nfrom 0 0 0\n", "2: the file ends inside a view: 'at' is missing"},
        Malformed{"FlatView", "v\nfrom 0 0 1\nat 0 0 0\nup 0 1 0\nangle 180\n",
                  "5: the angle of view must lie between 0 and 180 degrees"},
        Malformed{"NoPixels", "v\nfrom 0 0 1\nat 0 0 0\nup 0 1 0\nangle 45\nhither 0\nresolution 512 0\n",
                  "7: the resolution is '0', not an integer of at least 1"},
        Malformed{"TwoVertices", kStart + "p 2\n0 0 0\n1 1 1\n",
                  "10: polygon has 2 vertices; at least 3 are needed"},
        Malformed{"TwoSmoothVertices", kStart + "pp 2\n",
                  "10: polygon has 2 vertices; at least 3 are needed"},
        Malformed{"NegativeCount", kStart + "p -3\n",
                  "10: the number of vertices is '-3', not an integer of at least 0"},
        Malformed{"FractionalCount", kStart + "p 3.5\n",
                  "10: the number of vertices is '3.5', not an integer of at least 0"},
        Malformed{"MissingCount", kStart + "p\n", "10: the number of vertices is missing"},
        Malformed{"TruncatedPolygon", kStart + "p 4\n0 0 0\n1 0 0\n1 1 0\n",
                  "13: the file ends inside a polygon: vertex 4 of 4 is missing"},
        Malformed{"TruncatedNumber", kStart + "p 3\n0 0 0\n1 0 0\n1 1",
                  "13: a vertex of the polygon is missing"},
        Malformed{"TooFewVertices", kStart + "p 4\n0 0 0\n1 0 0\n1 1 0\ns 0 0 0 1\n",
                  "14: a vertex of the polygon is 's', not a finite number"},
        Malformed{"TooManyVertices", kStart + "p 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n",
                  "14: a record should begin here, not the number 0"},
        Malformed{"NormalsMissing", kStart + "pp 3\n0 0 0\n1 0 0\n1 1 0\n",
                  "11: a vertex normal of the polygon is missing"},
        Malformed{"NormalsUnasked", kStart + "p 3\n0 0 0 1 0 0\n", "11: '1' does not belong on this line"},
        Malformed{"NegativeRadius", kStart + "s 0 0 0 -0.5\n", "10: the radius -0.5 is negative"},
        Malformed{"NegativeConeRadius", kStart + "c 0 0 0 1 0 0 1 -2\n", "10: the radius -2 is negative"},
        Malformed{"TruncatedCone", kStart + "c\n0 0 0 1\n",
                  "11: the file ends inside a cone: the apex is missing"},
        Malformed{"NotANumber", kStart + "s 0 nan 0 1\n", "10: the centre is 'nan', not a finite number"},
        Malformed{"Infinite", kStart + "s 0 0 0 inf\n", "10: the radius is 'inf', not a finite number"},
        Malformed{"Overflow", kStart + "s 0 0 0 1e400\n", "10: the radius is '1e400', not a finite number"},
        Malformed{"TwoSigns", kStart + "s +-1 0 0 1\n", "10: the centre is '+-1', not a finite number"},
        Malformed{"Word", kStart + "s 0 0 0 1x\n", "10: the radius is '1x', not a finite number"},
        Malformed{"TrailingGarbage", kStart + "s 0 0 0 1 7\n", "10: '7' does not belong on this line"},
        Malformed{"UnknownRecord", kStart + "ppp 3\n",
                  "10: unknown record 'ppp'; did you mean 'pp'? known: b, v, l, f, p, pp, s, c"},
        Malformed{"ShortMaterial", kView + "f 1 1 1 1 0 1 0\n", "9: the index of refraction is missing"},
        Malformed{"HalfALightColour", kView + "l 0 0 0 1 1\n", "9: the light's colour is missing"}),
    [](const auto& test) { return test.param.name; });

TEST(ReadNff, RefusesBinaryFilesBriefly) {
  EXPECT_EQ(refusal(std::string(1 << 20, 'x')), "test.nff:1: the line is too long for a text file");
  EXPECT_EQ(refusal(kStart + "s 0 0 \x01\x02\xff 1\n"),
            "test.nff:10: the centre is '?\?\?', not a finite number");
}

TEST(ReadNff, ReadsLinesThatStraddleBlocks) {
  // Half a million bytes of spheres pass through the reader's quarter-million-byte block.
  std::string text = kStart;
  for (int i = 0; i < 20000; ++i) text += fmt::format("s {} {} {} 0.12345678901\n", i, -i, i * 0.1);
  const Scene scene = parse(text);
  ASSERT_EQ(scene.spheres.size(), 20000u);
  for (int i = 0; i < 20000; ++i)
    ASSERT_EQ(scene.spheres[i],
              (Sphere<double>{{1.0 * i, -1.0 * i, std::stod(fmt::format("{}", i * 0.1))}, 0.12345678901}));
}

TEST(ReadNff, NamesUnreadableFiles) {
  EXPECT_THAT([] { read_nff("no/such/file.nff"); },
              testing::ThrowsMessage<InputError>("cannot read no/such/file.nff: No such file or directory"));
  EXPECT_THAT([] { read_nff(std::filesystem::temp_directory_path()); },
              testing::ThrowsMessage<InputError>(HasSubstr("it is a directory")));
}

TEST(WriteNff, WritesRecordsInTheOrderOfSpd) {
  SceneBuilder builder;
  builder.background({0.078, 0.361, 0.753});
  builder.view({.from = {1, 2, 3}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle = 45, .hither = 0.01});
  builder.light({4, 3, 2});
  builder.light({1e-7, -1234567, 0}, Vec3d{1, 0.5, 1.0 / 3});
  builder.material({{1, 0.75, 0.33}, 0.8, 0, 100000, 0, 1});
  builder.cone({1, 2, 3}, 4, {5, 6, 7}, 8);
  builder.sphere({0, 0, -0.5}, 2);
  builder.material({});
  builder.patch({Vec3d{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {Vec3d{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  const Scene scene = std::move(builder).finish();
  EXPECT_EQ(
      written(scene, 6),
      "b 0.078 0.361 0.753\nv\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\nangle 45\nhither 0.01\nresolution 512 512\n"
      "l 4 3 2\nl 1e-07 -1.23457e+06 0 1 0.5 0.333333\n"
      "f 1 0.75 0.33 0.8 0 100000 0 1\nc 1 2 3 4 5 6 7 8\ns 0 0 -0.5 2\n"
      "f 1 1 1 1 0 1 0 1\npp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n");
}

TEST(WriteNff, KeepsMaterialsThatNoObjectHas) {
  SceneBuilder builder;
  for (int i = 0; i < 4; ++i) {
    builder.material({.diffuse = 0.25 * i});
    if (i == 2) builder.sphere({0, 0, 0}, 1);
  }
  const Scene scene = std::move(builder).finish();
  EXPECT_TRUE(same_content(parse(written(scene, kFullPrecision)), scene));
}

TEST(WriteNff, RepeatsAMaterialThatReturns) {
  Scene scene = parse(kStart + "s 0 0 0 1\n" + "f 0 0 0 1 0 1 0 1\n" + "s 0 0 0 2\ns 0 0 0 3\n");
  scene.objects[2].material = 0;
  const Scene again = parse(written(scene, kFullPrecision));
  ASSERT_EQ(again.materials.size(), 3u);
  EXPECT_EQ(again.materials[again.objects[2].material], scene.materials[0]);
}

TEST(WriteNff, RefusesWhatNffCannotExpress) {
  Scene scene = parse(kStart + "s 0 0 0 1\n");
  scene.spheres[0].radius = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { written(scene, 6); }, testing::ThrowsMessage<InputError>(HasSubstr("not finite")));
  EXPECT_THAT([&] { written(scene, 0); }, testing::ThrowsMessage<InputError>(HasSubstr("1 to 17")));
  EXPECT_THAT([&] { written(scene, 18); }, testing::ThrowsMessage<InputError>(HasSubstr("1 to 17")));
}

class WrittenFile : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / fmt::format("rayshoot_nff_{}", ::getpid());
  const Scene scene_ = parse(kStart + "s 0 0 0 1\n");
};

TEST_F(WrittenFile, AppearsCompleteAndAlone) {
  const std::string path = folder_ / "scene.nff";
  write_nff(scene_, path);
  EXPECT_TRUE(same_content(read_nff(path), scene_));
  EXPECT_EQ(files(), 1u);
}

TEST_F(WrittenFile, LeavesTheOldOneWhenWritingFails) {
  const std::string path = folder_ / "scene.nff";
  write_nff(scene_, path);
  Scene broken = scene_;
  broken.spheres[0].centre.x = std::numeric_limits<double>::infinity();
  EXPECT_THROW(write_nff(broken, path), InputError);
  EXPECT_TRUE(same_content(read_nff(path), scene_));
  EXPECT_EQ(files(), 1u);
}

TEST_F(WrittenFile, NamesUnwritablePaths) {
  EXPECT_THAT(
      [&] { write_nff(scene_, "no/such/folder/a.nff"); },
      testing::ThrowsMessage<InputError>("cannot write no/such/folder/a.nff: No such file or directory"));
  EXPECT_THAT([&] { write_nff(scene_, folder_); },
              testing::ThrowsMessage<InputError>(HasSubstr("it is not a regular file")));
  EXPECT_EQ(files(), 0u);
}

/// Small scenes of every generator, in both forms.
TEST(NffRoundTrip, KeepsEveryGeneratedSceneBitForBit) {
  for (const SceneGenerator* generator : scene_generators())
    for (const SceneForm form : {SceneForm::curves, SceneForm::patches}) {
      const Scene scene = generated(*generator, {.size = std::max(generator->min_size, 2), .form = form});
      if (!scene.placements.empty()) continue;
      const Scene again = parse(written(scene, kFullPrecision));
      EXPECT_TRUE(same_content(again, scene)) << generator->id;
      EXPECT_EQ(scene_hash(again), scene_hash(scene)) << generator->id;
    }
}

/// The quantities that the original programs' files were reduced to.
struct Aggregates {
  Box<double> bounds;
  double polygon_area = 0, patch_area = 0;
  /// A checksum over all coordinates and radii that depends on their order.
  double order_weighted_sum = 0;

  explicit Aggregates(const Scene& scene) : bounds(scene.bounds()) {
    for (std::uint32_t object = 0; object < scene.size(); ++object) add(scene, object);
  }

 private:
  void add(const Scene& scene, std::uint32_t object) {
    const SceneObject& entry = scene.objects[object];
    if (entry.kind == ObjectKind::sphere) {
      const auto& [centre, radius] = scene.spheres[entry.index];
      weigh({centre.x, centre.y, centre.z, radius});
    } else if (entry.kind == ObjectKind::cone) {
      const auto& [b, rb, a, ra] = scene.cones[entry.index];
      weigh({b.x, a.x, b.y, a.y, b.z, a.z, rb, ra});
    } else {
      std::vector<Vec3d> vertices;
      for (std::uint32_t corner = 0; corner < scene.vertex_count(object); ++corner) {
        const Vec3d& v = vertices.emplace_back(scene.vertex(object, corner));
        weigh({v.x, v.y, v.z});
      }
      const double area = length(make_polygon<double>(vertices, 0).normal) / 2;
      (entry.first_normal == kNoObject ? polygon_area : patch_area) += area;
    }
  }
  void weigh(std::initializer_list<double> numbers) {
    for (const double number : numbers) {
      const std::uint64_t weight = (position_++ * 2654435761u) % 1000003;
      order_weighted_sum += static_cast<double>(weight) / 1000003 * number;
    }
  }

  std::uint64_t position_ = 0;
};

void expect_near(double value, double expected, const std::string& what) {
  EXPECT_NEAR(value, expected, 1e-9 * std::max(1.0, std::abs(expected))) << what;
}

/// Scenes written with six digits have the aggregates of the files that the original SPD programs print.
TEST(NffSixDigits, AgreesWithTheFilesOfTheOriginalPrograms) {
  std::ifstream file(RAYSHOOT_TEST_DATA "/six_digit_nff.json");
  for (const auto& expected : nlohmann::json::parse(file)) {
    const SceneGenerator* generator = find_generator(expected["scene"]);
    ASSERT_NE(generator, nullptr) << expected;
    const SceneForm form = expected["form"] == "curves" ? SceneForm::curves : SceneForm::patches;
    const Scene scene = parse(written(generated(*generator, {.size = expected["size"], .form = form}), 6));
    const Aggregates found(scene);
    const std::string name = expected.dump();
    EXPECT_EQ(scene.materials.size(), expected["materials"]) << name;
    for (int axis = 0; axis < 3; ++axis) {
      expect_near(found.bounds.lo[axis], expected["bounds"][0][axis], name);
      expect_near(found.bounds.hi[axis], expected["bounds"][1][axis], name);
    }
    expect_near(found.polygon_area, expected["polygon_area"], name);
    expect_near(found.patch_area, expected["patch_area"], name);
    expect_near(found.order_weighted_sum, expected["order_weighted_sum"], name);
  }
}

}  // namespace
}  // namespace rayshoot
