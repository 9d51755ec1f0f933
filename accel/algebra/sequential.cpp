// Sequential composition (Revelles & Ureña 1999, §5.1)
//
// Idea       A1|A2 takes the voxels of A1 and builds an A2 over the objects of each (equations 15 to 17). A ray walks through
//            A1; each voxel that it meets hands it to the A2 inside. So a crowded corner of a scene gets a structure of its
//            own: the teapot in the stadium.
// Parameters until (8): a voxel with at most so many objects keeps its plain list, for a second structure would cost more
//            than it saves; box: where the second structure stands. `fit`, the part of the voxel where its objects are,
//            leaves out empty space and is the default; `voxel` is the whole voxel; `objects` reaches beyond it, but lets
//            voxels with the same objects share one structure.
// Cost       That of A1, and for each voxel on the ray that of its A2.
// Weak       where A1 has few objects a voxel already, and where large objects fall in many voxels.

#include "accel/algebra/sequential.h"

#include <deque>
#include <unordered_map>
#include <unordered_set>

#include "accel/algebra/numbers.h"
#include "accel/algebra/voxel_table.h"
#include "scenes/core/digest.h"

namespace rayshoot {

namespace {

/// Where the second part is built over the objects of a voxel.
template <class Real>
Box<Real> divided_box(const Geometry<Real>& geometry, const Voxel<Real>& voxel,
                      std::span<const std::uint32_t> objects, SequentialConfig::Box rule) {
  Box<Real> around;
  for (const std::uint32_t object : objects) around.include(geometry.bounds(object));
  const Box<Real> fit{max(around.lo, voxel.box.lo), min(around.hi, voxel.box.hi)};
  if (rule == SequentialConfig::Box::objects || voxel.widened || fit.empty()) return around;
  return rule == SequentialConfig::Box::voxel ? voxel.box : fit;
}

template <class Real>
class Sequential final : public Optimizer<Real>, public SpatialIndex<Real> {
 public:
  using typename SpatialIndex<Real>::ForVoxel;
  using Key = typename Voxel<Real>::Key;

  Sequential(const OptimizerInput<Real>& input, const BuildPart<Real>& first, const BuildPart<Real>& second,
             const SequentialConfig& config)
      : first_(first(input)), voxels_(first_->index()), until_(config.until) {
    if (!voxels_)
      throw InputError("the first part of a sequential composition must be based on spatial indexing");
    SubScenesByContent known;
    const Numbers<Real> number(input);
    std::vector<std::uint32_t> objects;
    std::vector<std::pair<Key, std::uint32_t>> divided;
    for_each_voxel_once([&](const Voxel<Real>& voxel) {
      ++places_;
      if (!is_divided(voxel.objects)) return;
      objects.resize(voxel.objects.size());
      std::transform(voxel.objects.begin(), voxel.objects.end(), objects.begin(), number);
      const Box<Real> box = divided_box(input.geometry, voxel, objects, config.box);
      divided.emplace_back(voxel.key, sub_scene_of(objects, box, input, second, known));
    });
    divided_ = divided.size();
    sub_scene_in_ = VoxelTable(divided_);
    for (const auto& [key, sub_scene] : divided) sub_scene_in_.add(key, sub_scene);
  }

  std::unique_ptr<EngineScratch> scratch() const override { return std::make_unique<Scratch>(*this); }

  /// Walk through the voxels of the first part, and in each through the second part inside (equation 16).
  bool visit(const Ray<Real>& ray, EngineScratch& scratch, LevelCount count,
             CandidateVisitor<Real>& visitor) const override {
    const LevelCount inside = count.below(first_->levels());
    const auto take_list = [&](Key, std::span<const std::uint32_t> objects) {
      inside.candidates(objects);
      return visitor(objects);
    };
    const auto take_sub_scene = [&](const Optimizer<Real>& second, EngineScratch& own) {
      return second.visit(ray, own, inside, visitor);
    };
    return visit_places(ray, scratch, count, visitor, take_list, take_sub_scene);
  }

  /// A1|A2 is based on spatial indexing where A2 is.
  const SpatialIndex<Real>* index() const override { return indexes_space_ ? this : nullptr; }

  /// The voxels of the second parts, and those of the first that keep their lists.
  void for_each_voxel(const ForVoxel& visit) const override {
    for_each_voxel_once([&](const Voxel<Real>& voxel) {
      if (!is_divided(voxel.objects)) return visit(voxel);
      second_in(voxel.key).index()->for_each_voxel([&](Voxel<Real> inside) {
        inside.around.push_back(voxel.box);
        inside.around.insert(inside.around.end(), voxel.around.begin(), voxel.around.end());
        visit(inside);
      });
    });
  }

  bool visit_voxels(const Ray<Real>& ray, EngineScratch& scratch, LevelCount count,
                    VoxelVisitor<Real>& visitor) const override {
    const auto take_list = [&](Key key, std::span<const std::uint32_t> objects) {
      return visitor(key, objects);
    };
    const auto take_sub_scene = [&](const Optimizer<Real>& second, EngineScratch& own) {
      return second.index()->visit_voxels(ray, own, count.below(first_->levels()), visitor);
    };
    return visit_places(ray, scratch, count, visitor, take_list, take_sub_scene);
  }

  StructureStats structure() const override {
    StructureStats stats = first_->structure(), inside;
    for (const SubScene& sub_scene : sub_scenes_) {
      inside += sub_scene.optimizer->structure();
      inside.bytes += sub_scene.geometry.bytes();
    }
    const std::uint64_t depth = stats.max_depth + inside.max_depth;
    stats += inside;
    stats.max_depth = depth;
    stats.bytes += sub_scene_in_.bytes();
    stats.figures = {{"voxels", static_cast<double>(places_)},
                     {"divided_voxels", static_cast<double>(divided_)},
                     {"sub_scenes", static_cast<double>(sub_scenes_.size())}};
    return stats;
  }

  std::size_t levels() const override { return first_->levels() + levels_inside_; }

 private:
  struct SubScene {
    std::vector<std::uint32_t> objects;
    Geometry<Real> geometry;
    std::unique_ptr<Optimizer<Real>> optimizer;
  };
  using SubScenesByContent = std::unordered_multimap<std::uint64_t, std::uint32_t>;

  struct Scratch final : EngineScratch {
    explicit Scratch(const Sequential& composition)
        : first(composition.first_->scratch()),
          inside(composition.sub_scenes_.size()),
          met(composition.shares_ ? static_cast<std::uint32_t>(inside.size()) : 0) {}

    std::unique_ptr<EngineScratch> first;
    /// Of each sub-scene that a ray has met yet.
    std::vector<std::unique_ptr<EngineScratch>> inside;
    /// Those that the ray has met, where several voxels share one.
    Mailbox met;
  };

  /// A voxel with few objects keeps its plain list.
  bool is_divided(std::span<const std::uint32_t> objects) const { return objects.size() > until_; }
  const Optimizer<Real>& second_in(Key voxel) const { return *sub_scenes_[sub_scene_in_[voxel]].optimizer; }

  /// Call visit for each voxel of the first part: one that several ways lead to is one all the same.
  template <class Visit>
  void for_each_voxel_once(const Visit& visit) const {
    std::unordered_set<Key> keys;
    voxels_->for_each_voxel([&](const Voxel<Real>& voxel) {
      if (keys.insert(voxel.key).second) visit(voxel);
    });
  }

  /// The sub-scene of these objects within that box: one that is known, or a new one.
  std::uint32_t sub_scene_of(std::span<const std::uint32_t> objects, const Box<Real>& box,
                             const OptimizerInput<Real>& input, const BuildPart<Real>& second,
                             SubScenesByContent& known) {
    Digest digest;
    digest.add(box), digest.add_all(objects);
    const auto [begin, end] = known.equal_range(digest.value());
    for (auto same = begin; same != end; ++same) {
      const SubScene& other = sub_scenes_[same->second];
      if (!(other.geometry.bounds() == box) ||
          !std::equal(objects.begin(), objects.end(), other.objects.begin(), other.objects.end()))
        continue;
      shares_ = true;
      return same->second;
    }
    const auto number = static_cast<std::uint32_t>(sub_scenes_.size());
    known.emplace(digest.value(), number);
    SubScene& made = sub_scenes_.emplace_back(
        SubScene{{objects.begin(), objects.end()}, input.geometry.part(objects, box), nullptr});
    std::vector<std::uint32_t> names;
    for (const std::uint32_t object : objects) names.push_back(input.name(object));
    made.optimizer = second({made.geometry, names, input.sample});
    indexes_space_ &= made.optimizer->index() != nullptr;
    levels_inside_ = std::max(levels_inside_, made.optimizer->levels());
    return number;
  }

  /// Hand each voxel on the ray to `take_list` or, where it is divided, its sub-scene to `take_sub_scene`: once a ray.
  template <class Visitor, class TakeList, class TakeSubScene>
  bool visit_places(const Ray<Real>& ray, EngineScratch& scratch, LevelCount count, const Visitor& asks,
                    const TakeList& take_list, const TakeSubScene& take_sub_scene) const {
    auto& own = static_cast<Scratch&>(scratch);
    const bool once = own.met.in_use();
    if (once) own.met.begin_ray();
    const auto take = [&](Key key, std::span<const std::uint32_t> objects) {
      count.candidates(objects);
      if (!is_divided(objects)) return take_list(key, objects);
      const std::uint32_t sub_scene = sub_scene_in_[key];
      if (once && !own.met.first_visit(sub_scene)) return false;
      const Optimizer<Real>& second = *sub_scenes_[sub_scene].optimizer;
      std::unique_ptr<EngineScratch>& its = own.inside[sub_scene];
      if (!its) its = second.scratch();
      return take_sub_scene(second, *its);
    };
    struct Voxels final : VoxelVisitor<Real> {
      Voxels(const decltype(take)& take, const Visitor& asks)
          : VoxelVisitor<Real>(asks.reach()), take_(take), asks_(asks) {}
      bool operator()(Key key, std::span<const std::uint32_t> objects) override {
        const bool end = take_(key, objects);
        this->reach_ = asks_.reach();
        return end;
      }

      const decltype(take)& take_;
      const Visitor& asks_;
    } voxels(take, asks);
    return voxels_->visit_voxels(ray, *own.first, count, voxels);
  }

  std::unique_ptr<Optimizer<Real>> first_;
  const SpatialIndex<Real>* voxels_;
  std::uint32_t until_;
  /// Voxels of the first part, and those of them that are divided.
  std::size_t places_ = 0, divided_ = 0;
  VoxelTable sub_scene_in_;
  /// Where they stand they stay: optimizers refer to their geometries.
  std::deque<SubScene> sub_scenes_;
  bool shares_ = false;
  /// Of all second parts.
  bool indexes_space_ = true;
  std::size_t levels_inside_ = 1;
};

}  // namespace

std::vector<Parameter> sequential_parameters(const SequentialConfig& defaults) {
  return {
      integer_parameter("until", defaults.until, 0, 1e9,
                        "a voxel with at most so many objects keeps its plain list"),
      choice_parameter(
          "box", defaults.box == SequentialConfig::Box::fit ? "fit" : "voxel", {"fit", "voxel", "objects"},
          "where the objects of a voxel are divided: in the voxel where they are, in all of it, or "
          "wherever they are")};
}

SequentialConfig sequential_config(const Arguments& arguments) {
  using Box = SequentialConfig::Box;
  const std::string& box = arguments.text("box");
  return {.until = static_cast<std::uint32_t>(arguments.integer("until")),
          .box = box == "fit"     ? Box::fit
                 : box == "voxel" ? Box::voxel
                                  : Box::objects};
}

template <class Real>
std::unique_ptr<Optimizer<Real>> sequential(const OptimizerInput<Real>& input, const BuildPart<Real>& first,
                                            const BuildPart<Real>& second, const SequentialConfig& config) {
  return std::make_unique<Sequential<Real>>(input, first, second, config);
}

template std::unique_ptr<Optimizer<float>> sequential(const OptimizerInput<float>&, const BuildPart<float>&,
                                                      const BuildPart<float>&, const SequentialConfig&);
template std::unique_ptr<Optimizer<double>> sequential(const OptimizerInput<double>&,
                                                       const BuildPart<double>&, const BuildPart<double>&,
                                                       const SequentialConfig&);

}  // namespace rayshoot
