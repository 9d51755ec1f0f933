// The adaptive 1-D grid (Arvo & Kirk §5.1, nonuniform subdivision)
// D. A. J. Jevans, "Ray Tracing Scenes of Varying Local Complexity", 1990.
//
// Idea       Cut a voxel into equal subvoxels along one axis, x, y and z in turn by depth, into as many as a cost
//            function finds cheapest for the objects in it and the rays that will come through it; none is a choice,
//            and nothing else limits the depth. The variables of a ray's walk along an axis live in a traversal state
//            that all voxels cut along that axis at the same absolute granularity share, so in a uniform region a ray
//            enters voxel after voxel without computing anything. A voxel is subdivided when the first ray comes to it.
// Parameters intcost, repcost, travcost, vertcost, subcost
//                            nanoseconds of the five steps of §6.2: an intersection, a repeated one, a step, an entry
//                            into a subdivided voxel, sorting an object. The defaults are what measure_code_timings
//                            printed, rounded; on another machine, paste what it prints there.
//            max_granularity 20, the paper's
//            axes            alternate, the paper's: the axis follows from the depth, and a voxel that does not pay
//                            there stays whole; an axis without room for two planes is passed over. paying: the voxel
//                            is then tried along the next axis; better for rods and sheets, and no faster in the
//                            scenes of the paper.
//            mailbox         auto: wherever the scene is subdivided at all, for how often objects are listed is not
//                            known before rays have come everywhere
// Sampling   Before the first ray, a small sample of the rays to come (RaySample) traverses the scene breadth first,
//            level by level, and subdivides as it goes; its rays end at the hits they find. How many come through a
//            voxel, times what each stands for, is the estimate of §6.5. A voxel that none comes through is estimated
//            by its share of the surface of its parent. Without a sample, 256 random lines stand for a million rays.
// Sharing    Voxels belong to all threads, not to each one's Scratch, where each would build them again. One thread at
//            a time subdivides, under a lock, and publishes the finished voxel with one atomic store (release), which
//            the others read (acquire); memory never moves. The decision depends on the voxel, the sample and the
//            parameters alone, so neither structure nor counts depend on who came first. Traversal states, which hold
//            the ray, are each thread's own.
// Cost       A step is a comparison of three distances; a move at a higher level costs going down again, in shared
//            states mostly without computation (the events that are counted; §5.2.2). structure() tells what has been
//            built so far: candidates_untouched are the voxels that no ray has come to, voxels_subdivided the states
//            that there would be without sharing.
// Weak       Long slanted objects fall into many subvoxels, by their bounds. Objects are assumed to be spread evenly in
//            a voxel. The first picture pays for subdivision.
//
// Exactness  Distances are not added up by a Δ: a state holds the distance to the next plane, computed from the plane.
//            A plane is rounded once from its place in the scene's box, so voxels of any granularity agree on it. Where
//            planes of several axes may be crossed at once, the ray moves at the lowest level whose next subvoxel it
//            may touch, and so visits all that it may. Subdivision also ends where planes would be nearer than 16 units
//            in the last place, or where references would exceed 160 an object (and 2^18) over all levels.

#include "accel/core/define_technique.h"
#include "accel/parts/grid_1d_walk.h"
#include "accel/parts/visit_cells.h"

namespace rayshoot {

namespace {

struct Grid1dConfig {
  Grid1dRules rules;
  MailboxUse mailbox = MailboxUse::automatic;
};

/// One thread's traversal states, and which objects its ray has met.
template <class Real>
struct Grid1dScratch {
  TraversalStates<Real> states;
  Mailbox mailbox;
};

template <class Real>
class Grid1d {
 public:
  using Scalar = Real;
  using Config = Grid1dConfig;
  using Scratch = Grid1dScratch<Real>;

  static TechniqueInfo info() {
    TechniqueInfo info{.id = "grid_1d",
                       .title = "Adaptive 1-D grid with shared traversal states, subdivided where rays come",
                       .family = "grid",
                       .survey_section = "5.1",
                       .paper = "Jevans 1990",
                       .events = kGrid1dEvents};
    for (const NamedTiming& timing : kNamedTimings)
      info.parameters.push_back(real_parameter(timing.name, kDefaultTimings.*timing.value, 0, 1e9,
                                               std::string("ns for ") + timing.what));
    info.parameters.push_back(integer_parameter("max_granularity", Grid1dRules{}.maximum_granularity, 1, 1000,
                                                "most subvoxels of a voxel"));
    info.parameters.push_back(
        choice_parameter("axes", "alternate", {"alternate", "paying"},
                         "a voxel not worth subdividing along its axis in the cycle x, y, z is left "
                         "whole, or tried along the next ones"));
    info.parameters.push_back(mailbox_parameter());
    return info;
  }
  static Config configure(const Arguments& arguments) {
    Config config;
    for (const NamedTiming& timing : kNamedTimings)
      config.rules.timings.*timing.value = arguments.real(timing.name);
    config.rules.maximum_granularity = static_cast<int>(arguments.integer("max_granularity"));
    config.rules.axes = arguments.text("axes") == "alternate" ? AxisRule::alternate : AxisRule::paying;
    config.mailbox = mailbox_use(arguments);
    return config;
  }

  static Grid1d build(const BuildInput<Real>& in, const Config& config) {
    Grid1d technique;
    technique.voxels_ = std::make_unique<Grid1dVoxels<Real>>(in.geometry, in.sample, config.rules);
    // Whether objects are listed twice is not known before rays have come everywhere.
    const bool divided = technique.voxels_->root().subdivided();
    if (config.mailbox == MailboxUse::on || (config.mailbox == MailboxUse::automatic && divided))
      technique.mailboxes_ = in.geometry.size();
    return technique;
  }

  Scratch scratch() const { return {{}, Mailbox(mailboxes_)}; }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& scratch, Counter count, L& leaf) const {
    const OnRay on_ray{*this, scratch.states};
    visit_objects_of_cells(on_ray, ray, scratch.mailbox, count, leaf);
  }

  StructureStats structure() const { return voxels_->structure(); }

 private:
  /// The voxels with the traversal states of a thread (visit_cells.h).
  struct OnRay {
    const Grid1d& grid;
    TraversalStates<Real>& states;

    template <class Counter, class Reach, class Visit>
    void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
      Grid1dWalk<Real, Counter, Reach, Visit>(*grid.voxels_, states, ray, count, reach, visit).run();
    }
  };

  std::unique_ptr<Grid1dVoxels<Real>> voxels_;
  /// Objects that need a mailbox; none where mailboxes are off.
  std::uint32_t mailboxes_ = 0;
};

}  // namespace

RAYSHOOT_TECHNIQUE(grid_1d, Grid1d)

}  // namespace rayshoot
