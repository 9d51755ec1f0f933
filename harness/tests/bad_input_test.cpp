// Bad usage and bad input, through the program: one line on stderr, nothing on stdout, status 2, nothing left behind.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "program.h"

namespace rayshoot::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct BadInput {
  std::string name;
  std::vector<std::string> arguments;
  /// What the message must say.
  std::string message;
  /// Content of a file `input` that the arguments name.
  std::string file = {};
  std::string input = "input.nff";

  friend void PrintTo(const BadInput& bad, std::ostream* out) { *out << bad.name; }
};

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename());
  return names;
}

class BadInputTest : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, GivesOneLineAndStatusTwo) {
  const TemporaryFolder folder;
  const std::filesystem::path input = folder.path() / GetParam().input;
  if (!GetParam().file.empty()) std::ofstream(input) << GetParam().file;
  const Outcome outcome = run_program(GetParam().arguments, folder.path());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.output, "");
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr(GetParam().message));
  std::filesystem::remove(input);
  EXPECT_THAT(files_in(folder.path()), IsEmpty());
}

const std::string kView = "v\nfrom 0 0 -5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 0.1\nresolution 8 8\n";
const std::string kMaterial = "f 1 1 1 1 0 0 0 1\n";

INSTANTIATE_TEST_SUITE_P(
    Usage, BadInputTest,
    ::testing::Values(
        BadInput{"no_command", {}, "a command is required; known: "},
        BadInput{"unknown_command", {"techniqes"}, "did you mean 'techniques'?"},
        BadInput{"unknown_option", {"scenes", "--jason"}, "did you mean '--json'?"},
        BadInput{"unknown_option_of_run", {"run", "--tecnique", "bvh_sah"}, "did you mean '--technique'?"},
        BadInput{"extra_argument", {"techniques", "more"}, "one argument too many"},
        BadInput{"missing_argument", {"scene"}, "SPEC"},
        BadInput{"missing_value", {"run", "--seed"}, "--seed"},
        BadInput{"not_a_number", {"run", "--seed", "one"}, "--seed"},
        BadInput{"no_threads", {"run", "--threads", "0"}, "--threads"},
        BadInput{"unknown_scalar", {"run", "--scalar", "half", "-o", "r.json"}, "known: float, double"},
        BadInput{"unknown_intersector",
                 {"run", "--intersector", "tight", "-o", "r.json"},
                 "known: fast, watertight"},
        BadInput{"unknown_case", {"torture", "--case", "closed_vertx"}, "did you mean 'closed_vertex'?"},
        BadInput{"torture_of_a_replay", {"torture", "--technique", "zero_overhead"}, "searches for nothing"},
        BadInput{"torture_of_no_size", {"torture", "--size", "0"}, "--size"},
        BadInput{"torture_without_rays", {"torture", "--ray-count", "0"}, "--ray-count"},
        BadInput{"laws_and_law", {"validate", "--laws", "tetra:1", "--law", "equation-3"}, "--law"},
        BadInput{"no_law", {"validate", "--law", "equation-3"}, "give --laws SCENE, or --law and --scene"},
        BadInput{"laws_of_no_scene", {"validate", "--laws", "tetar:1"}, "did you mean 'tetra'?"},
        BadInput{"no_shard", {"run", "quick", "--shard", "2", "-o", "r.json"}, "the second of three is 2/3"},
        BadInput{
            "shard_beyond_the_last", {"run", "quick", "--shard", "4/3", "-o", "r.json"}, "'4/3' is no shard"},
        BadInput{"shard_before_the_first",
                 {"run", "quick", "--shard", "0/3", "-o", "r.json"},
                 "'0/3' is no shard"},
        BadInput{"more_shards_than_scenes",
                 {"run", "quick", "--shard", "1/9", "-o", "r.json"},
                 "at most 8 shards"},
        BadInput{"resume_without_a_name", {"run", "quick", "--resume"}, "--output"},
        BadInput{"picture_of_no_file", {"report", "r.json", "--picture", "a.png"}, "a.png: cannot be opened"},
        BadInput{"merge_into_nothing", {"merge", "a.json"}, "--output"},
        BadInput{"merge_of_no_file", {"merge", "a.json", "-o", "b.json"}, "a.json: cannot be opened"},
        BadInput{"compare_of_one", {"compare", "a.json"}, "NEW"},
        BadInput{
            "compare_within_less_than_nothing", {"compare", "a", "b", "--tolerance", "-1"}, "--tolerance"},
        BadInput{"compare_in_an_unknown_format", {"compare", "a", "b", "--format", "html"}, "markdown"},
        BadInput{"page_of_nothing", {"report"}, "REPORT"},
        BadInput{"page_that_is_no_page", {"report", "a.json", "-o", "a.pdf"}, "a page ends in .html"},
        BadInput{"bound_of_nothing",
                 {"validate", "report.json", "--max-median-error", "0"},
                 "0 is not a number above 0"},
        BadInput{"bound_without_a_report", {"validate", "--max-median-error", "0.1"}, "REPORT"},
        BadInput{"model_without_a_report", {"validate", "--model", "havran"}, "REPORT"},
        BadInput{"report_and_law", {"validate", "a.json", "--law", "equation-3"}, "--law"},
        BadInput{"unknown_model", {"validate", "a.json", "--model", "havrn"}, "did you mean 'havran'?"},
        BadInput{"spearman_above_1", {"validate", "a.json", "--min-spearman", "2"}, "--min-spearman"},
        BadInput{"unknown_metric", {"table", "a.json", "--metric", "build"}, "known: objects, ray_count"},
        BadInput{"unknown_dimension", {"table", "a.json", "--rows", "tecnique"}, "technique"},
        BadInput{"growth_and_a_table_of_ones_own", {"table", "a.json", "--growth", "--mean"}, "--growth"},
        BadInput{"growth_and_regret", {"table", "a.json", "--growth", "--regret"}, "--growth"},
        BadInput{"no_m_error", {"run", "--target-m-error", "0", "-o", "r.json"}, "--target-m-error"},
        BadInput{"auto_of_no_scene", {"run", "auto", "-o", "r.json"}, "run auto: which scenes?"},
        BadInput{
            "auto_of_an_unknown_scene", {"run", "auto", "bals:2", "-o", "r.json"}, "did you mean 'balls'?"},
        BadInput{
            "scene_behind_a_suite", {"run", "quick", "balls:2", "-o", "r.json"}, "one argument too many"},
        BadInput{"regret_of_nothing_chosen",
                 {"run", "--scene", "balls:1", "--regret", "-o", "r.json"},
                 "go with run auto, or --technique auto"},
        BadInput{"race_of_nothing_chosen",
                 {"run", "--scene", "balls:1", "--no-race", "-o", "r.json"},
                 "go with run auto, or --technique auto"},
        BadInput{"unknown_candidate",
                 {"run", "auto", "balls:1", "--candidate", "bvh_sha", "-o", "r.json"},
                 "did you mean 'bvh_sah'?"},
        BadInput{"baseline_as_candidate",
                 {"run", "auto", "balls:1", "--candidate", "embree", "-o", "r.json"},
                 "'embree' is a point of comparison"},
        BadInput{"no_expected_rays",
                 {"run", "auto", "balls:1", "--expected-rays", "0", "-o", "r.json"},
                 "--expected-rays"},
        BadInput{"candidate_that_is_out_of_reach",
                 {"run", "auto", "tetra:8", "--candidate", "exhaustive", "-o", "r.json"},
                 "nothing is left to choose; exhaustive is left out"},
        BadInput{"unknown_rules", {"run", "--rules", "hanes", "-o", "r.json"}, "clean"},
        BadInput{"rules_for_rays_without",
                 {"run", "--rays", "chords", "--rules", "haines", "-o", "r.json"},
                 "no ray distribution of this run has a parameter 'rules'"},
        BadInput{"precision_of_a_mesh",
                 {"scene", "tetra:1", "--export", "t.obj", "--precision", "9"},
                 "--precision goes with"},
        BadInput{
            "precision_without_export", {"scene", "tetra:1", "--precision", "9"}, "--precision goes with"},
        BadInput{"precision_too_high",
                 {"scene", "tetra:1", "--export", "t.nff", "--precision", "18"},
                 "--precision"},
        BadInput{"unknown_format", {"scene", "tetra:1", "--export", "t.xyz"}, ".obj"},
        BadInput{"unknown_picture", {"render", "tetra:1", "-o", "t.jpg"}, ".png"},
        BadInput{"unknown_show", {"render", "tetra:1", "--show", "pretty", "-o", "t.png"}, "shaded"},
        BadInput{"render_without_search",
                 {"render", "tetra:1", "--technique", "zero_overhead", "-o", "t.png"},
                 "zero_overhead"},
        BadInput{
            "unknown_law", {"validate", "--law", "equation-4", "--scene", "tetra:1"}, "known: equation-3"}),
    [](const auto& instance) { return instance.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Names, BadInputTest,
    ::testing::Values(
        BadInput{"unknown_scene", {"scene", "bals:2"}, "did you mean 'balls'?"},
        BadInput{"unknown_scene_of_run", {"run", "--scene", "bals", "-o", "r.json"}, "did you mean 'balls'?"},
        BadInput{"unknown_scene_behind_a_known_one",
                 {"run", "--scene", "balls:1", "--scene", "bals", "-o", "r.json"},
                 "did you mean 'balls'?"},
        BadInput{"unknown_technique",
                 {"run", "--scene", "balls:1", "--technique", "bvh_sha", "-o", "r.json"},
                 "did you mean 'bvh_sah'?"},
        BadInput{"unknown_key",
                 {"run", "--scene", "balls:1", "--technique", "bvh_sah(max_object=2)", "-o", "r.json"},
                 "did you mean 'max_objects'?"},
        BadInput{"value_out_of_range",
                 {"run", "--scene", "balls:1", "--technique", "bvh_sah(max_objects=0)", "-o", "r.json"},
                 "max_objects=0 is not accepted"},
        BadInput{"unknown_rays",
                 {"run", "--scene", "balls:1", "--rays", "primry", "-o", "r.json"},
                 "did you mean 'primary'?"},
        BadInput{"unknown_suite", {"run", "quik", "-o", "r.json"}, "did you mean 'quick'?"},
        BadInput{"size_0", {"scene", "balls:0"}, "size=0 is not accepted"},
        BadInput{"size_far_too_large", {"scene", "balls:30"}, "GiB"},
        BadInput{"size_far_too_large_in_a_run", {"run", "--scene", "balls:30", "-o", "r.json"}, "GiB"},
        BadInput{"size_not_a_number", {"scene", "balls:many"}, "size=many is not accepted"}),
    [](const auto& instance) { return instance.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Files, BadInputTest,
    ::testing::Values(
        BadInput{"no_such_scene_file", {"scene", "none.nff"}, "none.nff"},
        BadInput{"no_such_scene_file_of_run", {"run", "--scene", "none.nff", "-o", "r.json"}, "none.nff"},
        BadInput{"truncated_nff",
                 {"scene", "input.nff"},
                 "input.nff:11: ",
                 kView + kMaterial + "p 3\n0 0 0\n1 0 0\n"},
        BadInput{"nan_in_nff", {"scene", "input.nff"}, "input.nff:9: ", kView + kMaterial + "s 0 nan 0 1\n"},
        BadInput{"nothing_in_range",
                 {"run", "--scene", "input.nff", "--scalar", "float", "--rays", "chords", "-o", "r.json"},
                 "input.nff: every object is out of range",
                 kView + kMaterial + "s 0 0 1e30 1\n"},
        BadInput{"polygon_of_two_vertices",
                 {"scene", "input.nff"},
                 "input.nff:9: ",
                 kView + kMaterial + "p 2\n0 0 0\n1 0 0\n"},
        BadInput{
            "negative_radius", {"scene", "input.nff"}, "input.nff:9: ", kView + kMaterial + "s 0 0 0 -1\n"},
        BadInput{"unknown_member_of_a_suite",
                 {"run", "suite.json", "-o", "r.json"},
                 "did you mean 'scenes'?",
                 R"({"scenses": ["balls:1"]})",
                 "suite.json"},
        BadInput{
            "suite_that_is_not_json", {"run", "suite.json", "-o", "r.json"}, "not JSON", "{", "suite.json"},
        BadInput{"compare_of_what_is_no_report", {"compare", "r.json", "r.json"}, "r.json: ", "{}", "r.json"},
        BadInput{"picture_of_another_kind",
                 {"report", "r.json", "--picture", "a.png"},
                 "not a PNG",
                 "GIF",
                 "a.png"},
        BadInput{"page_of_what_is_no_report", {"report", "r.json"}, "r.json: ", "{}", "r.json"},
        BadInput{"models_of_what_is_no_report", {"validate", "r.json"}, "r.json: ", "{}", "r.json"},
        BadInput{"models_of_no_file", {"validate", "none.json"}, "none.json"},
        BadInput{"unwritable_report",
                 {"run", "--scene", "balls:1", "-o", "none/r.json"},
                 "cannot write none/r.json"},
        BadInput{
            "unwritable_export", {"scene", "balls:1", "--export", "none/b.nff"}, "cannot write none/b.nff"},
        BadInput{"unwritable_picture", {"render", "balls:1", "-o", "none/b.png"}, "cannot write none/b.png"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace rayshoot::test
