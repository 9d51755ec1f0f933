#include "harness/render/render.h"

#include <gmock/gmock.h>
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#include <stb/stb_image.h>

#include <filesystem>

#include "accel/core/registry.h"
#include "analysis/plots/heat_scale.h"
#include "harness/render/heat_map.h"
#include "scenes/core/scene_builder.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

using analysis::end_of_scale, analysis::heat_colour;
using testing::HasSubstr;

constexpr double kGrey = 0.5;
constexpr Vec3d kSky{0.2, 0.4, 0.6};

Rgb bytes(const Vec3d& colour) {
  const auto byte = [](double value) { return static_cast<std::uint8_t>(std::lround(255 * value)); };
  return {byte(colour.x), byte(colour.y), byte(colour.z)};
}

/// What a grey of the screen stands for, and the grey that stands for so much light.
double light_of(double grey) { return std::pow((grey + 0.055) / 1.055, 2.4); }
double grey_of(double light) { return 1.055 * std::pow(light, 1 / 2.4) - 0.055; }

/// An eye at (0, 0, 5) that looks down on the plane z = 0.
SceneBuilder looking_down() {
  SceneBuilder builder;
  builder.background(kSky);
  builder.view({.from = {0, 0, 5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle = 20, .width = 9, .height = 9});
  return builder;
}

void square(SceneBuilder& builder, double z, double half) {
  builder.polygon(
      std::array{Vec3d{-half, -half, z}, Vec3d{half, -half, z}, Vec3d{half, half, z}, Vec3d{-half, half, z}});
}

Image drawn(const Scene& scene, const RenderOptions& options = {},
            const std::string& technique = "exhaustive") {
  const TechniqueEntry& entry = technique_entry(technique);
  return render(scene, entry, Arguments(entry.info.parameters, {}, technique), options);
}

Rgb middle(const Image& image) { return image.at(image.width() / 2, image.height() / 2); }

void expect_near(const Rgb& colour, const Rgb& expected) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(colour[k], expected[k], 1) << "channel " << k;
}

TEST(Shading, ShowsTheBackgroundInItsOwnColour) {
  expect_near(middle(drawn(std::move(looking_down()).finish())), bytes(kSky));
}

TEST(Shading, LightsMatteSurfacesByTheCosineAndLeavesShadowsToTheAmbientLight) {
  SceneBuilder builder = looking_down();
  builder.light({10, 0, 10});
  builder.material({.colour = {kGrey, kGrey, kGrey}, .diffuse = 0.8});
  square(builder, 0, 20);
  const double lit = light_of(kGrey) * 0.8 * (std::sqrt(0.5) + 0.06), dark = light_of(kGrey) * 0.8 * 0.06;
  Scene scene = std::move(builder).finish();
  expect_near(middle(drawn(scene)), bytes(Vec3d{1, 1, 1} * grey_of(lit)));

  scene.spheres.push_back({{5, 0, 5}, 1});
  scene.objects.push_back({.kind = ObjectKind::sphere});
  expect_near(middle(drawn(scene)), bytes(Vec3d{1, 1, 1} * grey_of(dark)));
}

TEST(Shading, SharesIntensityAmongLightsWithoutColour) {
  SceneBuilder builder = looking_down();
  for (int i = 0; i < 4; ++i) builder.light({0, 0, 10});
  builder.material({.colour = {kGrey, kGrey, kGrey}, .diffuse = 0.3});
  square(builder, 0, 20);
  // Four lights of 1/2 each.
  expect_near(middle(drawn(std::move(builder).finish())),
              bytes(Vec3d{1, 1, 1} * grey_of(light_of(kGrey) * 0.3 * 2.06)));
}

TEST(Shading, MirrorsPassOnTheirSpecularShare) {
  SceneBuilder builder = looking_down();
  builder.material({.diffuse = 0, .specular = 0.5});
  square(builder, 0, 20);
  const Rgb half = {bytes({grey_of(0.5 * light_of(kSky.x)), 0, 0})[0],
                    bytes({0, grey_of(0.5 * light_of(kSky.y)), 0})[1],
                    bytes({0, 0, grey_of(0.5 * light_of(kSky.z))})[2]};
  expect_near(middle(drawn(std::move(builder).finish())), half);
}

TEST(Shading, GlassThatDoesNotBendLightIsInvisible) {
  SceneBuilder builder = looking_down();
  builder.material({.diffuse = 0, .transmittance = 1, .index_of_refraction = 1});
  builder.sphere({0, 0, 0}, 1);
  for (const int x : {0, 2, 4})
    expect_near(drawn(std::move(SceneBuilder(builder)).finish()).at(x, 4), bytes(kSky));
}

TEST(Shading, TotallyReflectedLightKeepsItsTransmittedShare) {
  // A steep look through the flat side of glass at its other side, from which nothing leaves: the sky on this side.
  SceneBuilder builder = looking_down();
  builder.view({.from = {0, 0, 5}, .at = {0, 9, 0}, .up = {0, 0, 1}, .angle = 1, .width = 3, .height = 3});
  builder.material({.diffuse = 0, .transmittance = 1, .index_of_refraction = 1.5});
  const auto facing_down =
      std::array{Vec3d{-99, 99, 0}, Vec3d{99, 99, 0}, Vec3d{99, -99, 0}, Vec3d{-99, -99, 0}};
  builder.polygon(facing_down);  // met from its inner side
  expect_near(middle(drawn(std::move(builder).finish())), bytes(kSky));
}

TEST(Shading, HighlightsAppearWhereTheMirrorDirectionMeetsTheLight) {
  SceneBuilder builder = looking_down();
  builder.light({0, 0, 10});
  builder.material({.colour = {0, 0, 0}, .diffuse = 0, .specular = 0.25, .shine = 1000});
  square(builder, 0, 20);
  Scene scene = std::move(builder).finish();
  scene.background = {0, 0, 0};
  const Image image = drawn(scene, {.samples = 1});
  EXPECT_NEAR(middle(image)[0], bytes({grey_of(0.25), 0, 0})[0], 2);
  EXPECT_LT(image.at(0, 0)[0], 20);
}

TEST(Shading, IsTheSameForEveryTechniqueAndNumberOfThreads) {
  const Scene scene = load_scene("mount:2").scene;
  const Image image = drawn(scene, {.width = 40, .height = 30});
  for (const char* technique : {"bvh_sah", "exhaustive"}) {
    const Image other = drawn(scene, {.width = 40, .height = 30, .threads = 2}, technique);
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x)
        ASSERT_EQ(image.at(x, y), other.at(x, y)) << technique << " " << x << " " << y;
  }
}

TEST(HeatMaps, OfExhaustiveSearchAreOneColourAboveTheLegend) {
  const Scene scene = load_scene("tetra:2").scene;  // 16 triangles
  const Image image = drawn(scene, {.show = Show::tests, .width = 300, .height = 200, .threads = 2});
  EXPECT_EQ(image.width(), 300);
  EXPECT_GT(image.height(), 230);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x) ASSERT_EQ(image.at(x, y), heat_colour(16.0 / 20));
}

TEST(HeatMaps, ShowWhereTheWorkIs) {
  const Scene scene = load_scene("balls:2").scene;
  for (const Show show : {Show::tests, Show::steps}) {
    const Image image = drawn(scene, {.show = show, .width = 64, .height = 64}, "bvh_sah");
    EXPECT_NE(image.at(0, 0), image.at(32, 32));
  }
}

TEST(HeatMaps, EndTheirColoursAtARoundNumberThatFewExceed) {
  EXPECT_EQ(end_of_scale(std::vector<double>(1000, 0.0)), 1);
  EXPECT_EQ(end_of_scale(std::vector<double>(1000, 3.0)), 4);
  EXPECT_EQ(end_of_scale(std::vector<double>(1000, 50.0)), 50);
  EXPECT_EQ(end_of_scale(std::vector<double>(1000, 51.0)), 100);
  std::vector<double> outlier(1000, 7.0);
  outlier[500] = 9000;
  EXPECT_EQ(end_of_scale(outlier), 10);
}

TEST(HeatMaps, NumberTheirLegend) {
  // Two narrow maps, numbered at the ends alone: their last rows differ by the one digit at the end of the scale.
  const HeatMap two{40, 10, std::vector<double>(400, 2.0), "x", "y"};
  HeatMap four = two;
  for (double& value : four.values) value = 4;
  const Image a = heat_picture(two), b = heat_picture(four);
  std::size_t different_right = 0, different_left = 0;
  for (int y = a.height() - 12; y < a.height(); ++y)
    for (int x = 0; x < 40; ++x) (x < 20 ? different_left : different_right) += a.at(x, y) != b.at(x, y);
  EXPECT_GT(different_right, 0u);
  EXPECT_EQ(different_left, 0u);
}

TEST(HeatColours, GrowLighterFromEndToEnd) {
  const auto brightness = [](const Rgb& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
  for (double value = 0; value < 1; value += 0.01)
    EXPECT_LT(brightness(heat_colour(value)), brightness(heat_colour(value + 0.01))) << value;
  EXPECT_EQ(heat_colour(-1), heat_colour(0));
  EXPECT_EQ(heat_colour(2), heat_colour(1));
}

TEST(Png, ReadsBackPixelByPixel) {
  Image image(5, 3, {1, 2, 3});
  image.at(4, 2) = {250, 100, 0};
  const std::string path = testing::TempDir() + "/rayshoot_render_test.png";
  write_png(image, path);
  int width = 0, height = 0, channels = 0;
  stbi_uc* pixels = stbi_load(path.c_str(), &width, &height, &channels, 3);
  ASSERT_NE(pixels, nullptr);
  EXPECT_EQ(width, 5);
  EXPECT_EQ(height, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x)
      for (int k = 0; k < 3; ++k) EXPECT_EQ(pixels[3 * (5 * y + x) + k], image.at(x, y)[k]);
  stbi_image_free(pixels);
  std::filesystem::remove(path);
}

TEST(Png, SaysWhereItCannotBeWritten) {
  EXPECT_THROW(write_png(Image(2, 2), testing::TempDir() + "/no/such/folder/x.png"), InputError);
}

std::string refusal(const auto& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Render, RefusesWhatItCannotDraw) {
  const Scene scene = load_scene("tetra:1").scene;
  EXPECT_THAT(refusal([&] { drawn(scene, {.width = 20000, .height = 10}); }), HasSubstr("1 to 16384"));
  EXPECT_THAT(refusal([&] { drawn(scene, {.width = -1, .height = 10}); }), HasSubstr("1 to 16384"));
  EXPECT_THAT(refusal([&] { show_named("shade"); }), HasSubstr("did you mean 'shaded'"));

  TechniqueEntry crippled = technique_entry("exhaustive");
  crippled.build_double = nullptr;
  EXPECT_THAT(refusal([&] { render(scene, crippled, {}, {}); }), HasSubstr("double precision"));
  crippled.info.needs_recorded_hits = true;
  EXPECT_THAT(refusal([&] { render(scene, crippled, {}, {.show = Show::tests}); }),
              HasSubstr("replays hits"));
}

TEST(Render, TakesTheSizeOfTheView) {
  const Image image = drawn(std::move(looking_down()).finish());
  EXPECT_EQ(image.width(), 9);
  EXPECT_EQ(image.height(), 9);
}

}  // namespace
}  // namespace rayshoot
