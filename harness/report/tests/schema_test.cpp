#include <gmock/gmock.h>

#include <cstdlib>
#include <set>

#include "full_report.h"
#include "schema_validation.h"

namespace rayshoot::test {
namespace {

using nlohmann::json;

constexpr const char* kSchema = RAYSHOOT_SOURCE "/results/schema/report.schema.json";
constexpr const char* kGolden = RAYSHOOT_TEST_DATA "/report_v1.json";

json written(const report::Report& report) { return json::parse(report::to_json(report)); }

/// What the schema says against a full report with one value replaced.
std::string violation_with(const std::string& pointer, const json& value) {
  json document = written(full_report());
  document[json::json_pointer(pointer)] = value;
  return violation(load_json(kSchema), document);
}

TEST(Schema, AcceptsTheGoldenReport) { EXPECT_EQ(violation(load_json(kSchema), load_json(kGolden)), ""); }

TEST(Schema, AcceptsFreshReports) {
  EXPECT_EQ(violation(load_json(kSchema), written(full_report())), "");
  report::Report sparse;
  sparse.run.started_utc = "2025-01-02T03:04:05Z";
  EXPECT_EQ(violation(load_json(kSchema), written(sparse)), "");
  sparse.measurements = {{.scalar = "double", .query = "any", .verdict = {.status = report::Status::failed}}};
  EXPECT_EQ(violation(load_json(kSchema), written(sparse)), "");
}

TEST(Schema, RefusesWhatTheReaderRefuses) {
  EXPECT_THAT(violation_with("/measurements/0/work/ray", 1), testing::HasSubstr("[measurements][0][work]"));
  for (const char* parent :
       {"", "/run", "/environment", "/scenes/0", "/scenes/0/bounds", "/scenes/0/left_out/0", "/ray_sets/0",
        "/measurements/0", "/measurements/0/verdict", "/measurements/0/strict_work",
        "/measurements/0/structure", "/measurements/0/predicted", "/measurements/0/efficiency",
        "/measurements/0/threads/0", "/left_out/0", "/schema"})
    EXPECT_NE(violation_with(std::string(parent) + "/surprise", 1), "") << parent;
  EXPECT_NE(violation_with("/schema/version", 2), "");
  EXPECT_NE(violation_with("/scenes/0/objects", -1), "");
  EXPECT_NE(violation_with("/measurements/0/verdict/status", "good"), "");
  EXPECT_NE(violation_with("/measurements/0/trace_ns/0", nullptr), "");
  EXPECT_NE(violation_with("/measurements/0/config/rule", json::array()), "");
  EXPECT_NE(violation_with("/scenes/0/bounds/min", {1, 2}), "");
}

TEST(Schema, GivesAWrongAnswerNoTime) {
  EXPECT_NE(violation_with("/measurements/0/verdict/status", "wrong"), "");
}

/// Whether a schema, or every alternative inside it, describes each of its members and closes itself to others.
void check_definition(const json& definition, const std::string& name) {
  EXPECT_EQ(definition.value("additionalProperties", json()), json(false)) << name;
  for (const auto& [member, schema] : definition.at("properties").items())
    EXPECT_TRUE(schema.contains("description") || schema.contains("$ref") || schema.contains("const"))
        << name << "." << member;
}

std::set<std::string> keys(const json& object) {
  std::set<std::string> names;
  for (const auto& [name, value] : object.items()) names.insert(name);
  return names;
}

/// The schema and the code name the same members: a full report has each property of each definition.
TEST(Schema, HasTheMembersOfTheCode) {
  const json schema = load_json(kSchema), report = written(full_report());
  const json &cell = report["measurements"][0], &scene = report["scenes"][0];
  EXPECT_EQ(keys(report), keys(schema["properties"]));
  const std::pair<const char*, json> examples[] = {{"run", report["run"]},
                                                   {"environment", report["environment"]},
                                                   {"scene", scene},
                                                   {"left_out", scene["left_out"][0]},
                                                   {"ray_set", report["ray_sets"][0]},
                                                   {"measurement", cell},
                                                   {"verdict", cell["verdict"]},
                                                   {"work", cell["work"]},
                                                   {"tested_kinds", cell["tested_kinds"]},
                                                   {"structure", cell["structure"]},
                                                   {"predicted", cell["predicted"]},
                                                   {"sampled_prediction", cell["sampled_prediction"]},
                                                   {"end_point_overlap", cell["end_point_overlap"]},
                                                   {"work_map", cell["work_map"]},
                                                   {"efficiency", cell["efficiency"]},
                                                   {"thread_times", cell["threads"][0]},
                                                   {"left_out_cell", report["left_out"][0]},
                                                   {"errors", cell["errors"]},
                                                   {"ulps", cell["errors"]["ulps_of_t"]},
                                                   {"published_figure", cell["published"][0]},
                                                   {"claim", report["claims"][0]},
                                                   {"grading", report["gradings"][0]},
                                                   {"choice", report["choices"][0]},
                                                   {"candidate", report["choices"][0]["candidates"][0]}};
  EXPECT_EQ(std::size(examples), schema["definitions"].size());
  for (const auto& [name, object] : examples) {
    const json& definition = schema["definitions"][name];
    check_definition(definition, name);
    EXPECT_EQ(keys(object), keys(definition["properties"])) << name;
  }
}

int exit_status(const std::string& schema, const std::string& report) {
  const std::string command =
      fmt::format("{} '{}' '{}' 2>/dev/null", RAYSHOOT_VALIDATE_REPORT, schema, report);
  return WEXITSTATUS(std::system(command.c_str()));
}

TEST(ValidateReport, SaysByItsStatusWhetherAReportIsValid) {
  const std::string changed = testing::TempDir() + fmt::format("changed.{}.json", ::getpid());
  json document = load_json(kGolden);
  document["run"]["surprise"] = 1;
  std::ofstream(changed) << document;
  EXPECT_EQ(exit_status(kSchema, kGolden), 0);
  EXPECT_EQ(exit_status(kSchema, changed), 1);
  EXPECT_EQ(exit_status(kGolden, kSchema), 2);
  EXPECT_EQ(exit_status(kSchema, "/none"), 2);
  std::remove(changed.c_str());
}

}  // namespace
}  // namespace rayshoot::test
