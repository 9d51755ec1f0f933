#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "scenes/core/registry.h"
#include "scenes/tests/spd_reference.h"

namespace rayshoot::test {

namespace {

/// One scene of the databases, as the rows of the data files name it.
struct Case {
  std::string scene;
  SceneOptions options;
};

std::string name_of(const Case& c) {
  return fmt::format("{}_s{}_{}{}", c.scene, c.options.size,
                     c.options.form == SceneForm::curves ? "curves" : "patches", c.options.tessellation);
}

const SceneGenerator& generator(const std::string& id) {
  for (const SceneGenerator* generator : scene_generators())
    if (generator->id == id) return *generator;
  throw std::out_of_range(id);
}

Scene generate(const Case& c) {
  SceneBuilder builder(c.options);
  generator(c.scene).generate(c.options, {}, builder);
  return std::move(builder).finish();
}

/// Keys are "scene/s<size>/<c or t>".
Case parse_key(const std::string& key) {
  const auto first = key.find('/'), second = key.find('/', first + 1);
  const int size = std::stoi(key.substr(first + 2));
  return {key.substr(0, first),
          {size, key.substr(second + 1) == "c" ? SceneForm::curves : SceneForm::patches, 3}};
}

class SpdAggregates : public testing::TestWithParam<std::string> {};

TEST_P(SpdAggregates, EqualThoseOfTheOriginalPrograms) {
  expect_reference(GetParam(), aggregates_of(generate(parse_key(GetParam()))));
}

INSTANTIATE_TEST_SUITE_P(Spd, SpdAggregates, testing::ValuesIn(reference_keys()),
                         [](const auto& test) { return name_of(parse_key(test.param)); });

/// A row of the table of counts and bounds.
struct BoundsRow {
  Case scene;
  std::array<std::size_t, 5> counts;  // polygons, patches, spheres, cones, cylinders
  std::array<double, 6> bounds;
};

std::vector<BoundsRow> read_bounds() {
  std::ifstream file(RAYSHOOT_TEST_DATA "/spd_bounds.txt");
  std::vector<BoundsRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream in(line);
    BoundsRow row;
    std::string form;
    in >> row.scene.scene >> row.scene.options.size >> form >> row.scene.options.tessellation;
    row.scene.options.form = form == "curves" ? SceneForm::curves : SceneForm::patches;
    for (std::size_t& count : row.counts) in >> count;
    for (double& bound : row.bounds) in >> bound;
    if (!in) throw std::runtime_error("cannot read the row: " + line);
    rows.push_back(row);
  }
  return rows;
}

double six_digits(double value) { return std::stod(fmt::format("{:.6g}", value)); }

void PrintTo(const BoundsRow& row, std::ostream* out) { *out << name_of(row.scene); }

class SpdBounds : public testing::TestWithParam<BoundsRow> {};

TEST_P(SpdBounds, AndCountsEqualThoseOfTheOriginalPrograms) {
  const BoundsRow& row = GetParam();
  const Scene scene = generate(row.scene);
  const auto is_patch = [](const SceneObject& object) { return object.first_normal != kNoObject; };
  const auto is_cylinder = [](const Cone<double>& cone) { return cone.base_radius == cone.apex_radius; };
  const std::size_t patches = std::count_if(scene.objects.begin(), scene.objects.end(), is_patch);
  const std::size_t cylinders = std::count_if(scene.cones.begin(), scene.cones.end(), is_cylinder);
  const std::size_t polygons = scene.triangles.size() + scene.polygons.size() - patches;
  EXPECT_EQ(row.counts,
            (std::array{polygons, patches, scene.spheres.size(), scene.cones.size() - cylinders, cylinders}));

  const Box<double> box = scene.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(six_digits(box.lo[axis]), row.bounds[axis]);
    EXPECT_EQ(six_digits(box.hi[axis]), row.bounds[3 + axis]);
  }
}

INSTANTIATE_TEST_SUITE_P(Spd, SpdBounds, testing::ValuesIn(read_bounds()),
                         [](const auto& test) { return name_of(test.param.scene); });

class SpdGenerator : public testing::TestWithParam<const SceneGenerator*> {};

/// Small sizes in both forms and several tessellations.
std::vector<Case> small_cases(const SceneGenerator& generator) {
  std::vector<Case> cases;
  for (int size = generator.min_size; size < generator.min_size + 3; ++size) {
    cases.push_back({generator.id, {.size = size}});
    for (const int tessellation : {1, 3, 4})
      cases.push_back({generator.id, {size, SceneForm::patches, tessellation}});
  }
  return cases;
}

TEST_P(SpdGenerator, PredictsItsObjectCountExactly) {
  for (const Case& small : small_cases(*GetParam()))
    EXPECT_EQ(GetParam()->object_count(small.options, {}), generate(small).size()) << name_of(small);
}

TEST_P(SpdGenerator, GivesPatchesNormalsOfUnitLength) {
  const Scene scene = generate({GetParam()->id, {.size = 3, .form = SceneForm::patches}});
  // The normals of jacks are as long as the jacks are small: 3/4, 3/8 and 3/16 at the three levels.
  const double longest = GetParam()->id == "jacks" ? 16.0 / 3 : 1,
               shortest = GetParam()->id == "jacks" ? 4.0 / 3 : 1;
  for (const Vec3d& normal : scene.vertex_normals) {
    ASSERT_LE(length(normal), longest * (1 + 1e-14));
    ASSERT_GE(length(normal), shortest * (1 - 1e-14));
  }
}

TEST_P(SpdGenerator, DoesNotDependOnTheFormWithoutCurvedObjects) {
  const Scene curves = generate({GetParam()->id, {.size = 2}});
  const Scene patches = generate({GetParam()->id, {.size = 2, .form = SceneForm::patches}});
  EXPECT_TRUE(patches.spheres.empty() && patches.cones.empty());
  EXPECT_EQ(same_content(curves, patches), curves.spheres.empty() && curves.cones.empty());
}

/// The generators of this folder; later families of scenes have tests of their own.
std::vector<const SceneGenerator*> spd_generators() {
  std::vector<const SceneGenerator*> generators;
  for (const char* id : {"balls", "gears", "jacks", "lattice", "mount", "rings", "shells", "sombrero",
                         "teapot", "tetra", "tree"})
    generators.push_back(&generator(id));
  return generators;
}

INSTANTIATE_TEST_SUITE_P(Spd, SpdGenerator, testing::ValuesIn(spd_generators()),
                         [](const auto& test) { return test.param->id; });

}  // namespace

}  // namespace rayshoot::test
