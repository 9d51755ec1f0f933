// The program from end to end: listings that other programs read, pictures, and runs that are interrupted.
#include "program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "without_times.h"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#include <stb/stb_image.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/report/report.h"

namespace rayshoot::test {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::UnorderedElementsAre;
using ::testing::UnorderedElementsAreArray;

json listed(const std::vector<std::string>& arguments) {
  const Outcome outcome = run_program(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  return json::parse(outcome.output);
}

std::vector<std::string> members(const json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

std::vector<std::string> ids(const json& list) {
  std::vector<std::string> all;
  for (const json& entry : list) all.push_back(entry.at("id"));
  return all;
}

/// Every entry of a list has these members and no others, and every parameter says what it takes.
void expect_members(const json& list, const std::vector<std::string>& names) {
  ASSERT_TRUE(list.is_array());
  for (const json& entry : list) {
    EXPECT_THAT(members(entry), UnorderedElementsAreArray(names)) << entry;
    for (const json& parameter : entry.at("parameters")) {
      EXPECT_THAT(members(parameter),
                  UnorderedElementsAre("name", "type", "default", "range", "description"));
      for (const auto& [name, value] : parameter.items()) EXPECT_TRUE(value.is_string()) << parameter;
    }
  }
}

const json& entry(const json& list, const std::string& id) {
  for (const json& one : list)
    if (one.at("id") == id) return one;
  throw std::out_of_range(id);
}

TEST(Listings, NameTheScenes) {
  const json scenes = listed({"scenes", "--json"});
  expect_members(scenes,
                 {"id", "title", "source", "purpose", "default_size", "min_size", "parameters", "needs"});
  EXPECT_THAT(ids(scenes), IsSupersetOf({"balls", "gears", "mount", "rings", "teapot", "tetra", "tree",
                                         "lattice", "jacks", "shells", "sombrero", "stadium"}));
  EXPECT_EQ(entry(scenes, "balls").at("default_size"), 4);
  EXPECT_THAT(entry(scenes, "balls").at("needs"),
              ElementsAre("shadow rays", "reflected rays", "curved objects"));
}

TEST(Listings, NameTheTechniquesAndTheirParameters) {
  const json techniques = listed({"techniques", "--json"});
  expect_members(techniques, {"id", "title", "family", "survey_section", "paper", "baseline", "scalars",
                              "parameters", "needs"});
  EXPECT_THAT(ids(techniques), IsSupersetOf({"exhaustive", "bvh_sah", "bvh_goldsmith_salmon",
                                             "octree_glassner", "uniform_grid", "zero_overhead", "embree"}));
  EXPECT_EQ(entry(techniques, "uniform_grid").at("survey_section"), "5.2");
  EXPECT_EQ(entry(techniques, "uniform_grid").at("baseline"), false);
  EXPECT_EQ(entry(techniques, "zero_overhead").at("baseline"), true);
  EXPECT_THAT(entry(techniques, "uniform_grid").at("scalars"), ElementsAre("float", "double"));
  EXPECT_THAT(
      entry(techniques, "uniform_grid").at("parameters"),
      Contains(json{{"name", "mailbox"},
                    {"type", "choice"},
                    {"default", "auto"},
                    {"range", "auto|on|off"},
                    {"description",
                     "test an object once a ray however many cells refer to it; auto: where some object "
                     "is referred to twice"}}));
}

TEST(Listings, NameTheRays) {
  const json rays = listed({"rays", "--json"});
  expect_members(rays, {"id", "title", "source", "parameters", "needs_lights"});
  EXPECT_THAT(ids(rays), IsSupersetOf({"whitted", "primary", "chords", "points", "diffuse", "light"}));
  EXPECT_EQ(entry(rays, "light").at("needs_lights"), true);
  EXPECT_EQ(entry(rays, "chords").at("needs_lights"), false);
}

TEST(Listings, DescribeAScene) {
  const json scene = listed({"scene", "balls:2", "--json"});
  EXPECT_EQ(scene.at("id"), "balls:2/curves");
  EXPECT_EQ(scene.at("generator"), "balls");
  EXPECT_EQ(scene.at("size"), 2);
  EXPECT_EQ(scene.at("form"), "curves");
  EXPECT_EQ(scene.at("objects"), 92);
  EXPECT_EQ(scene.at("counts"),
            (json{{"triangle", 0}, {"polygon", 1}, {"sphere", 91}, {"cone", 0}, {"placed_part", 0}}));
  EXPECT_THAT(scene.at("bounds").at("min"), ElementsAre(-12, -12, -0.5));
  EXPECT_NEAR(scene.at("bounds").at("max")[2], 0.785071794692558, 1e-9);
  EXPECT_EQ(scene.at("lights"), 3);
  EXPECT_EQ(scene.at("materials"), 2);
  EXPECT_EQ(scene.at("hash").get<std::string>().size(), 16u);
  EXPECT_EQ(scene.at("needs"), (json{{"shadow_rays", true},
                                     {"reflected_rays", true},
                                     {"refracted_rays", false},
                                     {"curved_objects", true},
                                     {"triangles_only", false},
                                     {"placed_parts", false},
                                     {"motion", false}}));
  for (const json& line : scene.at("left_out")) EXPECT_THAT(members(line), ElementsAre("what", "why"));
  EXPECT_EQ(scene.at("set_aside"), (json{{"float", json::object()}, {"double", json::object()}}));
  EXPECT_FALSE(scene.contains("topology")) << "balls are no mesh";
}

TEST(Listings, DescribeTheTopologyOfAMesh) {
  const json topology = listed({"scene", "tetra:1", "--json"}).at("topology");
  EXPECT_EQ(topology.at("closed"), true);
  EXPECT_EQ(topology.at("faces"), 4);
  EXPECT_EQ(topology.at("vertices"), 4);
  EXPECT_EQ(topology.at("boundary_edges"), 0);
}

/// Width, height, and number of different colours of a picture.
std::array<std::size_t, 3> picture(const std::filesystem::path& file) {
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load(file.c_str(), &width, &height, &channels, 3), &stbi_image_free);
  std::set<std::array<stbi_uc, 3>> colours;
  for (int i = 0; pixels && i < width * height; ++i)
    colours.insert({pixels.get()[3 * i], pixels.get()[3 * i + 1], pixels.get()[3 * i + 2]});
  return {static_cast<std::size_t>(width), static_cast<std::size_t>(height), colours.size()};
}

class RenderedScene : public ::testing::TestWithParam<std::string> {};

TEST_P(RenderedScene, IsAPictureOfSomething) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(
      {"render", GetParam(), "--width", "48", "--height", "36", "-o", "picture.png"}, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  const auto [width, height, colours] = picture(folder.path() / "picture.png");
  EXPECT_EQ(width, 48u);
  EXPECT_EQ(height, 36u);
  EXPECT_GT(colours, 30u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RenderedScene,
                         ::testing::Values("balls:3", "gears:2", "mount:5", "rings:3", "teapot:6", "tetra:5",
                                           "tree:7", "lattice:5", "jacks:2", "shells:3", "sombrero:1"),
                         [](const auto& test) { return test.param.substr(0, test.param.find(':')); });

/// A run of which the first cell is done at once, and the last long after.
const std::vector<std::string> kLongRun{
    "run",     "--scene",     "balls:1",         "--scene", "balls:4",    "--scene",
    "gears:5", "--scene",     "tree:12",         "--rays",  "whitted@64", "--technique",
    "bvh_sah", "--technique", "octree_glassner", "-o",      "report.json"};

TEST(Expression, IsATechniqueWhereverOneIsExpected) {
  const TemporaryFolder folder;
  const Outcome run = run_program({"run", "--scene", "tetra:2", "--rays", "chords(rays=100)", "--technique",
                                   "uniform_grid(resolution=2x2x2)|bvh_sah", "--technique",
                                   "hug||octree_revelles", "--counts-only", "-o", "r.json"},
                                  folder.path());
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("uniform_grid(resolution=2x2x2)|bvh_sah"));
  EXPECT_THAT(run.output, HasSubstr("hug||octree_revelles"));
  EXPECT_EQ(
      run_program({"render", "tetra:1", "--technique", "hug|bvh_sah", "-o", "t.png"}, folder.path()).status,
      0);
}

TEST(Expression, ThatIsWrongIsShownWithACaret) {
  const TemporaryFolder folder;
  const Outcome wrong =
      run_program({"run", "--technique", "hug|(bvh_sah|hug", "-o", "r.json"}, folder.path());
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("\n  hug|(bvh_sah|hug\n                  ^\n"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "r.json"));
}

TEST(Validate, ChecksTheLawsOfTheAlgebra) {
  const Outcome laws = run_program({"validate", "--laws", "tetra:2"});
  EXPECT_EQ(laws.status, 0) << laws.output;
  EXPECT_THAT(laws.output, HasSubstr("(18) associative"));
  EXPECT_THAT(laws.output, Not(HasSubstr("FAILS")));
}

TEST(Auto, ChoosesExplainsAndMeasuresTheChoice) {
  const TemporaryFolder folder;
  const Outcome run = run_program({"run", "auto", "tetra:4", "balls:2", "--rays", "chords(rays=200)",
                                   "--no-race", "--counts-only", "-o", "r.json"},
                                  folder.path());
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("Chosen: "));
  EXPECT_THAT(run.output, HasSubstr("it tests every ray with each of 256 objects"));
  const report::Report report = report::read_report((folder.path() / "r.json").string());
  ASSERT_EQ(report.choices.size(), 2u);
  for (const report::Choice& choice : report.choices) {
    std::set<std::string> measured;
    for (const report::Measurement& measurement : report.measurements)
      if (measurement.scene == choice.scene) measured.insert(measurement.technique);
    EXPECT_THAT(measured, IsSupersetOf({choice.candidates.at(0).technique, std::string("embree")}));
    EXPECT_EQ(choice.pick, choice.candidates.at(0).spec);
  }
}

TEST(Auto, WithRegretMeasuresEveryCandidate) {
  const TemporaryFolder folder;
  const Outcome run = run_program(
      {"run", "--scene", "tetra:3", "--rays", "chords(rays=200)", "--technique", "auto", "--candidate",
       "bvh_sah", "--candidate", "uniform_grid(density=2)", "--regret", "-o", "r.json"},
      folder.path());
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("Chosen: "));
  const report::Report report = report::read_report((folder.path() / "r.json").string());
  EXPECT_EQ(report.measurements.size(), 2u);
}

TEST(Interrupt, EndsARunWithAReportOfWhatWasDone) {
  const TemporaryFolder folder;
  const Outcome outcome = interrupt_program(kLongRun, " of 8 cells", folder.path());
  EXPECT_EQ(outcome.status, 130) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("The run was interrupted"));
  const report::Report report = report::read_report((folder.path() / "report.json").string());
  EXPECT_FALSE(report.run.complete);
  ASSERT_FALSE(report.measurements.empty());
  EXPECT_LT(report.measurements.size(), 8u);
  EXPECT_EQ(report.measurements[0].scene, "balls:1/curves");
  EXPECT_FALSE(report.measurements[0].trace_ns.empty());
  std::vector<std::string> files;
  for (const auto& file : std::filesystem::directory_iterator(folder.path()))
    files.push_back(file.path().filename());
  EXPECT_THAT(files, ElementsAre("report.json")) << "nothing half-written";
}

/// A run without times, whose numbers are the same each time: three scenes at once and one that takes a second.
std::vector<std::string> counted_run(const std::string& output, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"run",     "--rays",      "whitted@64",      "--technique",
                                     "bvh_sah", "--technique", "octree_glassner", "--counts-only",
                                     "-o",      output};
  for (const char* scene : {"tetra:1", "balls:1", "tetra:2", "tree:10"})
    arguments.insert(arguments.end(), {"--scene", scene});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

report::Report read(const TemporaryFolder& folder, const std::string& name) {
  return report::read_report((folder.path() / name).string());
}

std::vector<std::string> files_in(const TemporaryFolder& folder) {
  std::vector<std::string> files;
  for (const auto& file : std::filesystem::directory_iterator(folder.path()))
    files.push_back(file.path().filename());
  return files;
}

TEST(Resume, GoesOnWhereARunWasKilled) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(counted_run("whole.json"), folder.path()).status, 0);
  interrupt_program(counted_run("report.json"), "6 of 8 cells", folder.path(), SIGKILL);
  EXPECT_THAT(files_in(folder), UnorderedElementsAre("whole.json", "report.json.unfinished"));
  EXPECT_FALSE(read(folder, "report.json.unfinished").run.complete);
  const std::size_t done = read(folder, "report.json.unfinished").scenes.size();
  EXPECT_GE(done, 2u);
  EXPECT_LT(done, 4u);
  const Outcome resumed = run_program(counted_run("report.json", {"--resume"}), folder.path());
  EXPECT_EQ(resumed.status, 0) << resumed.errors;
  EXPECT_THAT(resumed.errors, HasSubstr(fmt::format("of {} cells", 8 - 2 * done))) << "only what was missing";
  EXPECT_THAT(files_in(folder), UnorderedElementsAre("whole.json", "report.json"));
  EXPECT_EQ(without_times(read(folder, "report.json")), without_times(read(folder, "whole.json")));
}

TEST(Resume, GoesOnWhereARunWasInterrupted) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(counted_run("whole.json"), folder.path()).status, 0);
  EXPECT_EQ(interrupt_program(counted_run("report.json"), "6 of 8 cells", folder.path()).status, 130);
  EXPECT_FALSE(read(folder, "report.json").run.complete);
  EXPECT_EQ(run_program(counted_run("report.json", {"--resume"}), folder.path()).status, 0);
  EXPECT_EQ(without_times(read(folder, "report.json")), without_times(read(folder, "whole.json")));
  EXPECT_TRUE(read(folder, "report.json").run.complete);
}

TEST(Resume, RefusesAnotherCommandAndNeedsAName) {
  const TemporaryFolder folder;
  const std::vector<std::string> run{"run",     "--scene", "tetra:1", "--technique",
                                     "bvh_sah", "-o",      "r.json",  "--counts-only"};
  ASSERT_EQ(run_program(run, folder.path()).status, 0);
  auto other = run;
  other[2] = "tetra:2";
  other.push_back("--resume");
  const Outcome refused = run_program(other, folder.path());
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.errors, HasSubstr("r.json was begun by another command"));
  auto again = run;
  again.push_back("--resume");
  EXPECT_EQ(run_program(again, folder.path()).status, 0) << "of what is complete nothing is left to do";
  EXPECT_EQ(run_program({"run", "--scene", "tetra:1", "--resume"}, folder.path()).status, 2);
}

TEST(Shards, AreTogetherWhatOneRunIs) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(counted_run("whole.json"), folder.path()).status, 0);
  for (const std::string shard : {"1", "2", "3"})
    ASSERT_EQ(run_program(counted_run(shard + ".json", {"--shard", shard + "/3"}), folder.path()).status, 0);
  const Outcome merged =
      run_program({"merge", "1.json", "2.json", "3.json", "-o", "merged.json"}, folder.path());
  EXPECT_EQ(merged.status, 0) << merged.errors;
  EXPECT_THAT(merged.output, HasSubstr("4 scenes, 8 cells"));
  EXPECT_EQ(without_times(read(folder, "merged.json")), without_times(read(folder, "whole.json")));
  const Outcome twice = run_program({"merge", "1.json", "1.json", "-o", "twice.json"}, folder.path());
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.errors, HasSubstr("two runs have the scene tetra:1/curves"));
  EXPECT_THAT(files_in(folder), Not(Contains("twice.json")));
}

}  // namespace
}  // namespace rayshoot::test
