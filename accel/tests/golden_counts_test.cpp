// Counts are deterministic: a changed count is a bug or an explained improvement. data/golden_counts/<id>.txt holds a
// row of the technique for every scene and query; a failing row prints what it should be replaced by if the change is
// meant.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "accel/core/batch.h"
#include "accel/core/registry.h"
#include "scenes/io/load_scene.h"
#include "scenes/rays/load_rays.h"

namespace rayshoot {
namespace {

class NoTracer final : public Tracer {
 public:
  void closest(std::span<const Ray<double>>, std::span<Hit<double>>) const override { ADD_FAILURE(); }
  void any(std::span<const Ray<double>>, std::span<std::uint8_t>) const override { ADD_FAILURE(); }
};

std::set<std::string> golden_rows(const std::string& id) {
  std::ifstream file(fmt::format("{}/golden_counts/{}.txt", RAYSHOOT_TEST_DATA, id));
  EXPECT_TRUE(file) << id << ".txt is missing";
  std::set<std::string> rows;
  for (std::string line; std::getline(file, line);) rows.insert(line);
  return rows;
}

std::string row(const TechniqueEntry& entry, const char* spec, Query query) {
  const Scene scene = load_scene(spec).scene;
  const Geometry<double> geometry(scene);
  const RaySet set = make_rays("chords(rays=2000)", scene, NoTracer(), 1);
  const auto engine = entry.build<double>({geometry, Arguments(entry.info.parameters, {}, entry.info.id)});
  ThreadScratch<double> scratch(*engine);
  std::vector<Hit<double>> hits(set.rays.size());
  const Work w = count_work<double>(*engine, query, set.rays, hits, scratch, 1).total;
  const StructureStats s = engine->structure();
  std::string row = fmt::format(
      "{} {}: tests {} distinct {} volumes {} steps {} cells {} empty {} mailbox {}; nodes {} leaves {} "
      "empty {} references {} depth {}",
      spec,
      query == Query::closest ? "closest"
      : query == Query::any   ? "any"
                              : "strict",
      w.object_tests, w.distinct_objects, w.volume_tests, w.steps, w.cells, w.empty_cells, w.mailbox_hits,
      s.nodes, s.leaves, s.empty_leaves, s.references, s.max_depth);
  for (std::size_t kind = 0; kind < entry.info.events.size(); ++kind)
    row += fmt::format(" {} {}", entry.info.events[kind], w.events[kind]);
  return row;
}

class GoldenCounts : public ::testing::TestWithParam<const TechniqueEntry*> {};

TEST_P(GoldenCounts, AreExactlyAsRecorded) {
  const std::set<std::string> golden = golden_rows(GetParam()->info.id);
  for (const char* spec : {"gears:1/curves", "jacks:2/curves", "mount:3/patches", "teapot:3/curves"})
    for (const Query query : {Query::closest, Query::any, Query::strict}) {
      const std::string counted = row(*GetParam(), spec, query);
      EXPECT_TRUE(golden.contains(counted)) << counted;
    }
}

INSTANTIATE_TEST_SUITE_P(Techniques, GoldenCounts,
                         ::testing::ValuesIn(technique_entries().begin(), technique_entries().end()),
                         [](const auto& technique) { return technique.param->info.id; });

}  // namespace
}  // namespace rayshoot
