#include <fmt/format.h>

#include <memory>

#include "accel/algebra/expression.h"
#include "accel/core/registry.h"
#include "harness/verify/laws.h"

namespace rayshoot {

namespace {

/// Held against (10) and (11), and where they are based on spatial indexing against (12) and (14), as all techniques are.
constexpr const char* kExpressions[] = {
    "uniform_grid|uniform_grid",
    "uniform_grid|bvh_sah",
    "uniform_grid|kd_tree",
    "uniform_grid(storage=hashed)|octree_dda",
    "recursive_grid|octree_samet(max_depth=4)",
    "hug|bvh_goldsmith_salmon",
    "adaptive_grid|uniform_grid",
    "octree_glassner(max_depth=3)|uniform_grid",
    "octree_samet(max_depth=3)|bvh_kay_kajiya",
    "octree_gargantini(max_depth=3)|recursive_grid",
    "octree_dda(max_depth=3)|grid_1d",
    "octree_revelles(max_depth=3)|uniform_grid(density=2)",
    "octree_revelles(max_depth=3,assignment=surface)|octree_dda(max_depth=4)",
    "bsp_kaplan(max_depth=6)|bvh_rubin_whitted",
    "bsp_jansen(max_depth=6)|bounding_volumes",
    "kd_tree(max_depth=6)|octree_revelles",
    "bvh_sah(max_objects=64)|uniform_grid",
    "bvh_sah(max_objects=64)|kd_tree",
    "sequential(uniform_grid,bvh_sah,until=0,box=voxel)",
    "sequential(uniform_grid,kd_tree,until=2,box=objects)",
    "sequential(octree_revelles(max_depth=3),uniform_grid,box=voxel)",
    "octree_revelles(max_depth=2)|kd_tree(max_depth=4)|uniform_grid",
    "octree_revelles(max_depth=2)|(kd_tree(max_depth=4)|uniform_grid)",
    "uniform_grid||octree_revelles",
    "bvh_sah||uniform_grid",
    "bvh_kay_kajiya||bounding_volumes",
    "kd_tree||bvh_goldsmith_salmon||hug",
    "uniform_grid|bvh_sah||octree_dda(max_depth=3)|uniform_grid",
    "octree_revelles(max_depth=2)|(bvh_sah||octree_samet)",
    "recursive(uniform_grid(resolution=2x2x2),max_depth=4)",
    "recursive(uniform_grid(resolution=1x1x2),max_depth=5)",
    "recursive(bvh_sah(max_objects=64),max_depth=2)",
    "octree_revelles(max_depth=2)|recursive(uniform_grid(resolution=3x3x3),max_depth=2)",
};

/// A1 | (A2 | A3) = (A1 | A2) | A3.
constexpr const char* kTriples[][3] = {
    {"uniform_grid(density=0.1)", "octree_revelles(max_depth=3)", "bvh_sah"},
    {"octree_samet(max_depth=2)", "uniform_grid(density=0.5)", "kd_tree"},
    {"bsp_jansen(max_depth=5)", "hug", "bvh_kay_kajiya"},
    {"kd_tree(max_depth=4)", "bvh_sah(max_objects=16)", "uniform_grid"},
    {"bvh_sah(max_objects=48)", "adaptive_grid", "exhaustive"},
    {"recursive_grid", "bsp_kaplan(max_depth=3)", "octree_gargantini(max_depth=4)"},
};

/// A1|A2 and A1||A2.
constexpr const char* kPairs[][2] = {
    {"uniform_grid(density=0.1)", "bvh_sah"},       {"octree_dda(max_depth=3)", "uniform_grid"},
    {"bsp_kaplan(max_depth=5)", "octree_revelles"}, {"kd_tree(max_depth=5)", "bounding_volumes"},
    {"octree_glassner(max_depth=3)", "kd_tree"},    {"bvh_sah(max_objects=64)", "octree_samet"},
};

/// A = B|A.
constexpr const char* kRecursive[] = {"uniform_grid(resolution=2x2x2)", "uniform_grid(resolution=1x2x1)",
                                      "octree_samet(max_depth=1)", "bsp_jansen(max_depth=2)",
                                      "kd_tree(max_depth=2)"};

/// An expression built over the scene, and what laws ask of it.
class Subject {
 public:
  Subject(const std::string& text, const Geometry<double>& geometry)
      : entry_(compose(parse_expression(text, technique_entries()))),
        engine_(entry_.build<double>({geometry, arguments_})),
        scratch_(engine_->scratch()) {}

  CandidateSet candidates(Query query) const {
    return [this, query](const Ray<double>& ray) { return engine_->candidates(query, ray, *scratch_); };
  }
  CandidateSet strict() const { return candidates(Query::strict); }

 private:
  Arguments arguments_;
  TechniqueEntry entry_;
  std::unique_ptr<Engine<double>> engine_;
  std::unique_ptr<EngineScratch> scratch_;
};

class Checks {
 public:
  Checks(const Geometry<double>& geometry, const std::vector<Ray<double>>& rays,
         const std::function<void(const LawCheck&)>& report)
      : geometry_(geometry), laws_(geometry, rays), report_(report) {}

  /// (10) to (14) of a technique or an expression.
  void of_one(const std::string& text) const {
    const Subject subject(text, geometry_);
    report_(laws_.strict_optimizer(text, subject.strict()));
    report_(laws_.optimizer(text, subject.candidates(Query::closest)));
    const std::vector<VoxelContent> voxels = representation_of(text);
    if (voxels.empty()) return;
    report_(laws_.covers(text, voxels));
    report_(laws_.indexes_space(text, subject.strict(), voxels));
  }

  void of_pair(const std::string& first, const std::string& second) const {
    const std::string parallel = first + "||" + second;
    report_(laws_.parallel(parallel, Subject(parallel, geometry_).strict(),
                           Subject(first, geometry_).strict(), Subject(second, geometry_).strict()));
    const std::string sequential = fmt::format("sequential({},{},until=0,box=objects)", first, second);
    const auto over = [&](const Objects& objects) -> CandidateSet {
      return [scene = std::make_shared<SubScene>(second, geometry_, objects)](const Ray<double>& ray) {
        return scene->candidates(ray);
      };
    };
    report_(laws_.sequential(sequential, Subject(sequential, geometry_).strict(), representation_of(first),
                             over));
  }

  void of_triple(const std::string& first, const std::string& second, const std::string& third) const {
    const std::string left = fmt::format("{}|({}|{})", first, second, third),
                      right = fmt::format("({}|{})|{}", first, second, third);
    report_(laws_.equal("(18) associative", left, Subject(left, geometry_).strict(),
                        Subject(right, geometry_).strict()));
  }

  void of_recursion(const std::string& part) const {
    const std::string whole = fmt::format("recursive({},max_depth=4)", part),
                      unrolled =
                          fmt::format("sequential({},recursive({},max_depth=3),box=voxel)", part, part);
    report_(laws_.equal("(20) A = B|A", whole, Subject(whole, geometry_).strict(),
                        Subject(unrolled, geometry_).strict()));
  }

 private:
  /// The second part over some of the objects.
  class SubScene {
   public:
    SubScene(const std::string& text, const Geometry<double>& geometry, const Objects& objects)
        : objects_(objects),
          part_(geometry.part(objects, bounds_of(geometry, objects))),
          subject_(text, part_) {}

    Objects candidates(const Ray<double>& ray) const {
      Objects found = subject_.strict()(ray);
      for (std::uint32_t& object : found) object = objects_[object];
      return found;
    }

   private:
    static Box<double> bounds_of(const Geometry<double>& geometry, const Objects& objects) {
      Box<double> bounds;
      for (const std::uint32_t object : objects) bounds.include(geometry.bounds(object));
      return bounds;
    }

    Objects objects_;
    Geometry<double> part_;
    Subject subject_;
  };

  /// m(s) of an expression; nothing where it is not based on spatial indexing.
  std::vector<VoxelContent> representation_of(const std::string& text) const {
    const Expression expression = parse_expression(text, technique_entries());
    if (!expression.indexes_space()) return {};
    const auto optimizer = compose(expression).build_optimizer<double>({geometry_}, {});
    return representation(*optimizer->index());
  }

  const Geometry<double>& geometry_;
  Laws laws_;
  const std::function<void(const LawCheck&)>& report_;
};

}  // namespace

void check_laws(const Geometry<double>& geometry, const std::vector<Ray<double>>& rays,
                const std::function<void(const LawCheck&)>& report) {
  if (geometry.has_placed()) throw InputError("laws are checked in scenes without placed parts");
  const Checks checks(geometry, rays, report);
  for (const TechniqueEntry* entry : technique_entries())
    if (entry->composable() && geometry.size() <= entry->info.max_practical_objects)
      checks.of_one(entry->info.id);
  for (const char* expression : kExpressions) checks.of_one(expression);
  for (const auto& [first, second] : kPairs) checks.of_pair(first, second);
  for (const auto& [first, second, third] : kTriples) checks.of_triple(first, second, third);
  for (const char* part : kRecursive) checks.of_recursion(part);
}

}  // namespace rayshoot
