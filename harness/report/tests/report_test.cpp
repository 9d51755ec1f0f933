#include "harness/report/report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "full_report.h"
#include "harness/report/join.h"

namespace rayshoot::report {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// What `from_json` says against a text; empty when it accepts it.
std::string objection(const std::string& text) try {
  from_json(text);
  return {};
} catch (const ReportError& error) {
  return error.what();
}

/// A full report with one value of its JSON replaced, as text.
std::string with(const std::string& pointer, const json& value) {
  json document = json::parse(to_json(test::full_report()));
  document[json::json_pointer(pointer)] = value;
  return document.dump();
}

std::string without(const std::string& parent, const std::string& member) {
  json document = json::parse(to_json(test::full_report()));
  EXPECT_EQ(document[json::json_pointer(parent)].erase(member), 1u);
  return document.dump();
}

std::string contents(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder that is there while a test runs.
class Folder {
 public:
  Folder() : path_(std::filesystem::path(testing::TempDir()) / fmt::format("report_test.{}", ::getpid())) {
    std::filesystem::create_directory(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& name) const { return path_ / name; }
  std::ptrdiff_t files() const {
    return std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator());
  }

 private:
  std::filesystem::path path_;
};

TEST(Report, ReadsBackWhatItWrote) {
  const Report report = from_json(to_json(test::full_report()));
  EXPECT_EQ(to_json(report), to_json(test::full_report()));
  const Measurement& measurement = report.measurements.at(0);
  EXPECT_EQ(report.run.seed, 18446744073709551615u);
  EXPECT_EQ(report.scenes.at(0).bounds->max[2], 0.1);
  EXPECT_EQ(measurement.config.at("density"), ConfigValue(0.1));
  EXPECT_EQ(measurement.config.at("resolution"), ConfigValue(std::int64_t{-1}));
  EXPECT_EQ(measurement.config.at("mailbox"), ConfigValue(true));
  EXPECT_EQ(measurement.config.at("rule"), ConfigValue(std::string("woo")));
  EXPECT_EQ(measurement.verdict.status, Status::graded);
  EXPECT_EQ(measurement.strict_work->mailbox_hits, 11u);
  EXPECT_EQ(measurement.threads.at(0).trace_ns.at(1), 1650);
}

/// A real number stays one: density 2.0 must not come back as the whole number 2.
TEST(Report, KeepsTypesOfConfigurationValues) {
  Report report = test::full_report();
  report.measurements[0].config = {{"density", 2.0}};
  EXPECT_TRUE(
      std::holds_alternative<double>(from_json(to_json(report)).measurements[0].config.at("density")));
}

/// Reports of version 1 stay readable for ever: this file is never written anew.
TEST(Report, ReadsTheGoldenFileOfVersion1) {
  const Report report = read_report(RAYSHOOT_TEST_DATA "/report_v1.json");
  EXPECT_EQ(report.run.id, "20250102T030405.678Z-9");
  ASSERT_EQ(report.measurements.size(), 3u);
  EXPECT_EQ(report.measurements[0].trace_ns, (std::vector<double>{3000, 3100, 3050}));
  EXPECT_EQ(report.measurements[1].verdict.status, Status::wrong);
  EXPECT_FALSE(report.measurements[1].work);
  EXPECT_EQ(report.measurements[2].verdict.message, "out of memory");
  EXPECT_FALSE(report.scenes.at(1).bounds);
  EXPECT_EQ(report.left_out.at(0).why, "it is slow");
  EXPECT_EQ(to_json(report), contents(RAYSHOOT_TEST_DATA "/report_v1.json"));
}

TEST(Report, LeavesOutWhatWasNotMeasured) {
  Report report = test::full_report();
  Measurement& measurement = report.measurements[0];
  measurement.work.reset();
  measurement.trace_ns.clear();
  measurement.threads.clear();
  const json written = json::parse(to_json(report))["measurements"][0];
  for (const char* name : {"work", "trace_ns", "threads"}) EXPECT_FALSE(written.contains(name)) << name;
  EXPECT_FALSE(from_json(to_json(report)).measurements[0].work);
}

TEST(Report, NeverWritesANumberThatIsNotFinite) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  Report report = test::full_report();
  report.environment.load = nan;
  report.scenes[0].bounds->max[1] = inf;
  Measurement& measurement = report.measurements[0];
  measurement.config = {{"alpha", 0.5}, {"limit", inf}};
  measurement.trace_ns[1] = nan;
  measurement.predicted->volume_tests_per_ray = nan;
  measurement.efficiency->m_ci95[0] = -inf;
  const Report read = from_json(to_json(report));
  EXPECT_FALSE(read.environment.load || read.scenes[0].bounds);
  EXPECT_EQ(read.measurements[0].config.size(), 1u);
  EXPECT_TRUE(read.measurements[0].trace_ns.empty());
  EXPECT_FALSE(read.measurements[0].predicted || read.measurements[0].efficiency);
  EXPECT_TRUE(read.measurements[0].work);
  report.run.seconds = nan;
  EXPECT_THROW(to_json(report), ReportError);
}

TEST(Report, WritesNamesThatAreNotUtf8) {
  Report report = test::full_report();
  report.run.command = "rayshoot run --scene caf\xe9.nff";
  EXPECT_EQ(from_json(to_json(report)).run.command, "rayshoot run --scene caf\uFFFD.nff");
}

struct Fault {
  std::string text, message;
};

TEST(Report, NamesThePlaceOfAFaultAndWhatWasExpected) {
  const std::string work = "/measurements/0/work/object_tests";
  const Fault faults[] = {
      {with("/run/sed", 1), "run: unknown member 'sed'; known: id, command, "},
      {with("/measurements/0/work/ray", 1), "measurements[0].work: unknown member 'ray'; known: rays, "},
      {with("/extra", 1), "unknown member 'extra'; known: run, environment, "},
      {without("/measurements/0/verdict", "status"),
       "measurements[0].verdict: the member 'status' is missing"},
      {without("", "scenes"), "the member 'scenes' is missing"},
      {with(work, -1), "measurements[0].work.object_tests: expected a whole number, 0 or more, found -1"},
      {with(work, 1.5), "expected a whole number, 0 or more, found 1.5"},
      {with(work, "1"), "expected a whole number, 0 or more, found \"1\""},
      {with("/measurements/0/trace_ns/1", nullptr),
       "measurements[0].trace_ns[1]: expected a number, found null"},
      {with("/measurements/0/trace_ns", 5), "measurements[0].trace_ns: expected a list, found 5"},
      {with("/measurements/0/work", json::array()), "measurements[0].work: expected an object, found array"},
      {with("/measurements/0/config/rule", json::array()), "expected true, false, a number or a string"},
      {with("/measurements/0/config/rule", 18446744073709551615u), "a whole number of 64 bits"},
      {with("/measurements/0/verdict/status", "good"),
       "expected one of ok, wrong, graded, failed, found \"good\""},
      {with("/measurements/0/scalar", "half"),
       "measurements[0].scalar: expected one of float, double, found"},
      {with("/measurements/0/query", 1),
       "measurements[0].query: expected one of closest, any, closest+any, found 1"},
      {with("/scenes/0/bounds/min", {1, 2}), "scenes[0].bounds.min: expected a list of 3 numbers"},
      {with("/scenes/0/counts/sphere", "many"), "scenes[0].counts.sphere: expected a whole number"},
      {with("/run/git_dirty", 1), "run.git_dirty: expected true or false, found 1"},
      {with("/run/id", 1), "run.id: expected a string, found 1"},
      {with("/environment/cores", 5000000000), "environment.cores: expected a whole number of 32 bits"},
      {with("/measurements/0/scene", "x"), "measurements[0].scene: no scene 'x' in scenes"},
      {with("/measurements/0/rays", "x"), "measurements[0].rays: no ray set 'x' in ray_sets"},
      {with("/measurements/0/verdict/status", "wrong"),
       "measurements[0].trace_ns: a wrong answer has no time"},
      {with("/measurements/0/work_map/resolution", 16385),
       "measurements[0].work_map.resolution: expected 1 to 16384, found 16385"},
      {with("/measurements/0/work_map/tile", 0),
       "measurements[0].work_map.tile: expected 1 to 3, the resolution, found 0"},
      {with("/measurements/0/work_map/tile", 4), "the resolution, found 4"},
      {with("/measurements/0/work_map/tile", 1),
       "measurements[0].work_map.object_tests: expected 9 numbers, one a tile, found 4"},
      {with("/measurements/0/work_map/volume_tests", {1, 2, 3}),
       "measurements[0].work_map.volume_tests: expected 4 numbers, one a tile, found 3"},
  };
  for (const auto& [text, message] : faults) EXPECT_THAT(objection(text), HasSubstr(message));
}

TEST(Report, ReadsItsOwnVersionOnly) {
  for (const int version : {0, 2})
    EXPECT_EQ(objection(with("/schema/version", version)),
              fmt::format("schema.version: version {} is not read, only version 1", version));
  EXPECT_EQ(objection(with("/schema/name", "other")), "schema.name: expected rayshoot.report, found other");
  EXPECT_EQ(objection(with("/schema/units", "ns")), "schema: unknown member 'units'; known: name, version");
  EXPECT_EQ(objection("{}"), "this is no report: it has no member 'schema'");
  EXPECT_EQ(objection("[1]"), "this is no report: it has no member 'schema'");
}

TEST(Report, RefusesWhatIsNotJson) {
  for (const std::string text : {"", "{", "{} x", "{\"run\": 1e999}", "\xff"}) {
    EXPECT_THAT(objection(text), testing::StartsWith("this is not JSON: ")) << text;
    EXPECT_THAT(objection(text), testing::Not(HasSubstr("\n"))) << text;
  }
  EXPECT_EQ(objection("{\"run\": {\"id\": 1, \"id\": 2}}"), "the member \"id\" is there twice");
}

TEST(Report, WritesAFileAtOnceOrNotAtAll) {
  const Folder folder;
  write_report(test::full_report(), folder / "report.json");
  EXPECT_EQ(to_json(read_report(folder / "report.json")), to_json(test::full_report()));
  EXPECT_EQ(folder.files(), 1);
  EXPECT_THROW(write_report(test::full_report(), folder / "none/report.json"), ReportError);
  std::filesystem::create_directory(folder / "taken");
  EXPECT_THROW(write_report(test::full_report(), folder / "taken"), ReportError);
  EXPECT_EQ(folder.files(), 2);
}

TEST(Report, NamesTheFileItCannotRead) {
  const Folder folder;
  std::ofstream(folder / "bad.json") << "{";
  for (const std::string name : {"none.json", "bad.json", ""}) try {
      read_report(folder / name);
      ADD_FAILURE() << name;
    } catch (const ReportError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith((folder / name) + ": "));
    }
}

TEST(Join, PutsRunsOfOtherScenesTogether) {
  const Report first = test::full_report();
  Report second = first;
  second.run.id = "another", second.scenes[0].id = "gears:1", second.run.complete = true;
  const Report whole = joined({first, second});
  EXPECT_EQ(whole.run.id, first.run.id);
  EXPECT_EQ(whole.run.seconds, 2 * first.run.seconds);
  EXPECT_EQ(whole.run.phase_seconds, (std::map<std::string, double>{{"trace", 1.5}, {"other", 1}}));
  EXPECT_FALSE(whole.run.complete);
  EXPECT_EQ(whole.scenes.size(), 2u);
  EXPECT_EQ(whole.ray_sets.size(), 2u);
  ASSERT_EQ(whole.measurements.size(), 2u);
  EXPECT_TRUE(whole.measurements[0].work_map && whole.measurements[1].work_map);
  EXPECT_EQ(whole.left_out.size(), 2u);
  EXPECT_EQ(whole.claims.size(), 2u);
  EXPECT_EQ(whole.gradings.size(), 2u);
  EXPECT_EQ(whole.choices.size(), 2u);
}

TEST(Join, RefusesRunsThatDoNotCompare) {
  const Report first = test::full_report();
  EXPECT_THROW(joined({}), ReportError);
  EXPECT_THROW(joined({first, first}), ReportError) << "a scene twice";
  Report second = first;
  second.scenes[0].id = "gears:1", second.environment.cpu = "another";
  EXPECT_THROW(joined({first, second}), ReportError);
}

}  // namespace
}  // namespace rayshoot::report
