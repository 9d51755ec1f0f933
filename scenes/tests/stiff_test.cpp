#include <gmock/gmock.h>

#include <set>

#include "scenes/core/digest.h"
#include "scenes/tests/exhaustive_tracer.h"
#include "scenes/tests/stiff_settings.h"

namespace rayshoot {
namespace {

/// The bytes of rays, since not-a-numbers are not equal to themselves.
std::string digest_of(const std::vector<Ray<double>>& rays) {
  Digest digest;
  digest.add_all(rays);
  return digest.hex();
}

/// Call `check(setting)` for every setting of the short form of every case.
template <class Check>
void for_every_setting(const Check& check) {
  for (const StiffCase* entry : stiff_cases())
    for (const StiffSetting& setting : entry->settings(1, 3)) {
      SCOPED_TRACE(entry->id + ": " + setting.label);
      check(setting);
    }
}

bool is_float(double x) { return std::isnan(x) || static_cast<double>(static_cast<float>(x)) == x; }
bool is_float(const Vec3d& p) { return is_float(p.x) && is_float(p.y) && is_float(p.z); }

TEST(Stiff, EveryCaseSaysWhatItIs) {
  std::set<int> numbers;
  EXPECT_EQ(stiff_cases().size(), 28u);
  for (const StiffCase* entry : stiff_cases()) {
    EXPECT_TRUE(numbers.insert(entry->number).second) << entry->id;
    EXPECT_TRUE(entry->number >= 1 && entry->number <= 28) << entry->id;
    for (const std::string& text : {entry->title, entry->construction, entry->property, entry->metric})
      EXPECT_FALSE(text.empty()) << entry->id;
  }
}

TEST(Stiff, SettingsHoldTogether) {
  for (const StiffCase* entry : stiff_cases()) {
    const std::vector<StiffSetting> settings = entry->settings(1, 3);
    std::set<std::string> labels, ids;
    EXPECT_GE(settings.size(), 3u) << entry->id;
    for (const StiffSetting& setting : settings) {
      EXPECT_TRUE(labels.insert(setting.label).second) << entry->id << ": " << setting.label;
      EXPECT_THAT(setting.label, testing::HasSubstr("=")) << entry->id;
      EXPECT_THAT(setting.scene->id, testing::StartsWith(entry->id + "(")) << setting.label;
      EXPECT_LE(setting.scene->size(), 6000u) << entry->id << ": " << setting.label;
      EXPECT_GT(setting.default_rays, 0u);
      EXPECT_TRUE(setting.property != Property::same_as_base || setting.base) << setting.label;
      EXPECT_LT(setting.base.value_or(0), settings.size());
    }
  }
}

TEST(Stiff, LargerFormsHaveNoFewerSettings) {
  for (const StiffCase* entry : stiff_cases())
    EXPECT_GE(entry->settings(2, 3).size(), entry->settings(1, 3).size()) << entry->id;
}

TEST(Stiff, RaysAreAFunctionOfSeedAndNumber) {
  for_every_setting([](const StiffSetting& setting) {
    const auto whole = rays_of(setting, 64, 1000);
    std::vector<Ray<double>> pieces = rays_of(setting, 7, 1000);
    for (const auto& [first, count] : {std::pair{1007, 1}, {1008, 56}})
      for (const Ray<double>& ray : rays_of(setting, count, first)) pieces.push_back(ray);
    EXPECT_EQ(digest_of(whole), digest_of(pieces));
    EXPECT_EQ(digest_of(whole), digest_of(rays_of(setting, 64, 1000)));
  });
}

TEST(Stiff, ScenesAreAFunctionOfTheSeed) {
  for (const StiffCase* entry : stiff_cases()) {
    const auto first = entry->settings(1, 3), second = entry->settings(1, 3);
    for (std::size_t i = 0; i < first.size(); ++i)
      EXPECT_EQ(scene_hash(*first[i].scene), scene_hash(*second[i].scene)) << first[i].scene->id;
  }
}

TEST(Stiff, NumbersAreFloats) {
  for_every_setting([](const StiffSetting& setting) {
    for (const Ray<double>& ray : rays_of(setting, 200)) {
      EXPECT_TRUE(is_float(ray.origin) && is_float(ray.direction) && is_float(ray.t_min));
      EXPECT_TRUE(is_float(ray.t_max) || ray.t_max == std::numeric_limits<double>::max());
    }
    for (const auto& [a, b, c] : setting.scene->triangles)
      EXPECT_TRUE(is_float(a) && is_float(b) && is_float(c));
    for (const Vec3d& vertex : setting.scene->polygon_vertices) EXPECT_TRUE(is_float(vertex));
    for (const auto& [centre, radius] : setting.scene->spheres)
      EXPECT_TRUE(is_float(centre) && is_float(radius));
    for (const Cone<double>& cone : setting.scene->cones)
      EXPECT_TRUE(is_float(cone.base) && is_float(cone.apex) && is_float(cone.base_radius) &&
                  is_float(cone.apex_radius));
  });
}

/// Whether an answer has the property that its setting states, if that can be told without an oracle. Leaks are left
/// to the measurement of them.
bool holds(const StiffSetting& setting, const Hit<double>& hit, const Hit<double>& base) {
  if (setting.property == Property::never_hit) return hit.object == kNoObject;
  if (setting.property != Property::same_as_base) return true;
  return hit.object == base.object && hit.t == base.t * setting.t_scale;
}

TEST(Stiff, ExhaustiveSearchInDoublesHasThePropertiesButLeaks) {
  for (const StiffCase* entry : stiff_cases()) {
    const auto settings = entry->settings(1, 3);
    for (const StiffSetting& setting : settings) {
      const StiffSetting& base = settings[setting.base.value_or(0)];
      const auto rays = rays_of(setting, 100), base_rays = rays_of(base, 100);
      std::vector<Hit<double>> hits(rays.size()), base_hits(rays.size());
      ExhaustiveTracer(*setting.scene).closest(rays, hits);
      ExhaustiveTracer(*base.scene).closest(base_rays, base_hits);
      for (std::size_t i = 0; i < rays.size(); ++i)
        EXPECT_TRUE(holds(setting, hits[i], base_hits[i]))
            << entry->id << ": " << setting.label << ", ray " << i;
    }
  }
}

}  // namespace
}  // namespace rayshoot
