#pragma once

#include "accel/parts/grid_1d_voxels.h"

namespace rayshoot {

/// What is counted, by position in `TechniqueInfo::events`: how the traversal state of a voxel got ready for the ray
/// that entered it (Jevans 1990, §5.2.2).
enum Grid1dEvent : std::size_t {
  states_initialized,  ///< the ray had not been in the state before
  states_reused,       ///< it had: only its index and distances were computed
  uniform_cases,       ///< the comparison voxel has the same state and extents: nothing was to be done
  adjacent_cases,      ///< it has the same state and touches: the index is that at the common border
  differing_cases      ///< it has the same state and lies elsewhere: the index was computed
};
inline const std::vector<std::string> kGrid1dEvents = {"states_initialized", "states_reused", "uniform_cases",
                                                       "adjacent_cases", "differing_cases"};

/// The variables of a traversal state for the ray that was there last.
template <class Real>
struct TraversalState {
  /// The voxel in which it is used.
  const SubdividedVoxel<Real>* voxel = nullptr;
  std::uint32_t ray_id = 0;
  /// The ray's subvoxel.
  std::int32_t index = 0;
  /// The earliest and the latest parameter at which the ray crosses into the next subvoxel, and the latest at which
  /// it crossed into this one.
  Real next{}, passed{}, behind{};
  /// Where the ray starts, and how far it goes in a unit of its parameter, in subvoxels of the absolute granularity.
  Real start{}, pace{};
};

/// The traversal states of one thread.
template <class Real>
class TraversalStates {
 public:
  /// Begin a ray with a signature of its own.
  void begin_ray() {
    if (++ray_id_ != 0) return;
    for (const auto& block : blocks_)
      for (std::uint32_t state = 0; state < kBlock; ++state) block[state].ray_id = 0;
    ray_id_ = 1;
  }
  std::uint32_t ray_id() const { return ray_id_; }

  TraversalState<Real>& operator[](std::uint32_t state) {
    if (state / kBlock >= blocks_.size()) [[unlikely]]
      grow(state);
    return blocks_[state / kBlock][state % kBlock];
  }

 private:
  static constexpr std::uint32_t kBlock = 256;

  /// Voxels, and states with them, are made while rays are traced.
  [[gnu::noinline, gnu::cold]] void grow(std::uint32_t state) {
    while (state / kBlock >= blocks_.size())
      blocks_.push_back(std::make_unique<TraversalState<Real>[]>(kBlock));
  }

  /// States stay where they are when others are added.
  std::vector<std::unique_ptr<TraversalState<Real>[]>> blocks_;
  std::uint32_t ray_id_ = 0;
};

/// The way of one ray through the voxels: those leaves are visited, near to far, in which a hit can lie.
template <class Real, class Counter, class Reach, class Visit>
class Grid1dWalk {
 public:
  using Voxel = SubdividedVoxel<Real>;
  using State = TraversalState<Real>;
  using Content = typename Subvoxel<Real>::Content;

  Grid1dWalk(Grid1dVoxels<Real>& voxels, TraversalStates<Real>& states, const Ray<Real>& ray, Counter count,
             const Reach& reach, const Visit& visit)
      : voxels_(voxels),
        states_(states),
        ray_(ray),
        crossings_(ray),
        count_(count),
        reach_(reach),
        visit_(visit) {}

  void run() {
    // Leave out rays that miss the scene.
    const Interval<Real> inside = crossings_.inside(voxels_.box());
    const bool meets = inside.enter <= inside.exit && inside.exit > ray_.t_min && inside.enter <= reach_() &&
                       ray_.t_min < reach_() && inside.enter < Box<Real>::infinity();
    if (!meets) return;
    states_.begin_ray();
    for (int axis = 0; axis < 3; ++axis) start_in_scene(axis);

    // Descend to the leaf where the ray begins, then move on and descend again.
    entered_ = std::max(inside.enter, ray_.t_min);
    if (descend(voxels_.root())) return;
    while (move())
      if (descend(subvoxel())) return;
  }

 private:
  /// The ray along an axis.
  struct Axis {
    std::int32_t step;  ///< +1 or -1
    Real start, pace;   ///< its distance from the scene's minimum, and by how much that grows
    Real origin, earliest, latest;

    /// As those of Crossings.
    Real enter(Real plane) const { return (plane - origin) * earliest; }
    Real exit(Real plane) const { return (plane - origin) * latest; }
    /// The planes through which the ray comes into a subvoxel and leaves it.
    std::int32_t rear(std::int32_t index) const { return step > 0 ? index : index + 1; }
    std::int32_t front(std::int32_t index) const { return step > 0 ? index + 1 : index; }
  };

  /// Where no voxel is subdivided along an axis, the ray moves out of the scene.
  void start_in_scene(int axis) {
    const Box<Real>& box = voxels_.box();
    const bool forward = !(crossings_.inverse[axis] < 0);
    const Real far = forward ? box.hi[axis] : box.lo[axis];
    axes_[axis] = {forward ? 1 : -1,  ray_.origin[axis] - box.lo[axis], ray_.direction[axis],
                   ray_.origin[axis], crossings_.earliest[axis],        crossings_.latest[axis]};
    scene_[axis] = {.next = axes_[axis].enter(far), .passed = axes_[axis].exit(far)};
    now_[axis] = &scene_[axis];
  }

  Content subvoxel() const {
    return current_->subvoxels()[static_cast<std::uint32_t>(now_[current_->axis]->index)].read();
  }

  /// §5.2: go down to a leaf and visit it; true when the visit must end.
  bool descend(Content content) {
    for (;;) {
      if (content.undecided()) [[unlikely]]
        content = voxels_.decide(*current_, static_cast<std::uint32_t>(now_[current_->axis]->index));
      if (!content.subdivided()) return visit_(content.objects());
      count_.step();
      enter(*content.voxel());
      content = subvoxel();
    }
  }

  /// Make a voxel the current one, and its traversal state ready (§5.2.2).
  void enter(const Voxel& voxel) {
    State& state = states_[voxel.state];
    state.voxel = &voxel;
    now_[voxel.axis] = &state;
    current_ = &voxel;
    const Voxel* const comparison = comparison_[voxel.axis];
    if (comparison && comparison->state == voxel.state) {
      if (comparison->first == voxel.first) {
        // Uniform subdivision: the ray is where it was, unless it may cross a plane just here.
        count_.event(uniform_cases);
        const auto granularity = static_cast<std::int32_t>(voxel.granularity);
        if (state.index >= granularity || !(state.behind < entered_)) place(state, state.index);
      } else if (comparison->first == voxel.maximum_extent()) {
        count_.event(adjacent_cases);
        place(state, static_cast<std::int32_t>(voxel.granularity) - 1);
      } else if (comparison->maximum_extent() == voxel.first) {
        count_.event(adjacent_cases);
        place(state, 0);
      } else {
        count_.event(differing_cases);
        place(state, located(state));
      }
      return;
    }
    if (state.ray_id != states_.ray_id()) {
      count_.event(states_initialized);
      state.ray_id = states_.ray_id();
      state.start = axes_[voxel.axis].start * voxel.subvoxels_per_length;
      state.pace = axes_[voxel.axis].pace * voxel.subvoxels_per_length;
    } else {
      count_.event(states_reused);
    }
    place(state, located(state));
  }

  /// §5.2.1: the subvoxel in which the ray enters, give or take one for rounding.
  std::int32_t located(const State& state) const {
    const Real position = state.start + entered_ * state.pace - static_cast<Real>(state.voxel->first);
    const Real last = static_cast<Real>(state.voxel->granularity - 1);
    return position > 0 ? static_cast<std::int32_t>(std::min(position, last)) : 0;
  }

  /// Stand in the rearmost subvoxel in which the ray may be where it enters, which is near `index`.
  void place(State& state, std::int32_t index) const {
    const Axis& axis = axes_[state.voxel->axis];
    const Real* planes = state.voxel->planes();
    const std::int32_t last = static_cast<std::int32_t>(state.voxel->granularity) - 1;
    const std::int32_t begin = axis.step > 0 ? 0 : last, end = last - begin;
    index = std::min(index, last);
    Real behind = axis.exit(planes[axis.rear(index)]);
    while (behind >= entered_ && index != begin) {
      index -= axis.step;
      behind = axis.exit(planes[axis.rear(index)]);
    }
    Real front = planes[axis.front(index)];
    while (axis.exit(front) < entered_ && index != end) {
      index += axis.step;
      behind = axis.exit(front);
      front = planes[axis.front(index)];
    }
    state.index = index;
    state.behind = behind;
    state.next = axis.enter(front);
    state.passed = axis.exit(front);
  }

  /// §5.3: move the ray into the next subvoxel, at whatever level; false when it leaves the scene or ends.
  bool move() {
    for (int axis = 0; axis < 3; ++axis) comparison_[axis] = now_[axis]->voxel;
    // The smallest distance tells the axis of the movement.
    const State &x = *now_[0], &y = *now_[1], &z = *now_[2];
    const int small = x.passed < y.next && x.passed < z.next   ? 0
                      : y.passed < x.next && y.passed < z.next ? 1
                      : z.passed < x.next && z.passed < y.next ? 2
                                                               : -1;
    if (small < 0) [[unlikely]]
      return move_where_planes_meet();
    if (reach_() < now_[small]->next) return false;
    entered_ = std::max(now_[small]->next, ray_.t_min);

    // Where the ray exits a voxel, go on in the previous voxel of that axis, until there is none.
    State* state = now_[small];
    while (state->voxel && !advance(*state, *state->voxel)) state = above(*state->voxel, small);
    if (!state->voxel) return false;
    now_[small] = state;
    make_current(*state->voxel);
    return true;
  }

  /// Planes of several axes may be crossed at once, and subvoxels between them touched by an edge or a corner: go up
  /// level by level to the first whose next subvoxel the ray may enter before it is out of all others.
  [[gnu::noinline, gnu::cold]] bool move_where_planes_meet() {
    for (const Voxel* voxel = current_; voxel; voxel = voxel->context->parent) {
      now_[voxel->axis] = &states_[voxel->state];
      make_current(*voxel);
      const Real next = now_[voxel->axis]->next;
      const Real until = std::min(now_[(voxel->axis + 1) % 3]->passed, now_[(voxel->axis + 2) % 3]->passed);
      if (!(next <= until && next <= reach_()) || !advance(*now_[voxel->axis], *voxel)) continue;
      entered_ = std::max(next, ray_.t_min);
      return true;
    }
    return false;
  }

  /// Step into the next subvoxel of a voxel on the ray's path; false when it has none.
  bool advance(State& state, const Voxel& voxel) {
    const Axis& axis = axes_[voxel.axis];
    const std::int32_t index = state.index + axis.step;
    if (static_cast<std::uint32_t>(index) >= voxel.granularity) return false;
    count_.step();
    const Real front = voxel.planes()[axis.front(index)];
    state.index = index;
    state.behind = state.passed;
    state.next = axis.enter(front);
    state.passed = axis.exit(front);
    return true;
  }

  /// The traversal state of the lowest voxel above along an axis.
  State* above(const Voxel& voxel, int axis) {
    return voxel.above[axis] ? &states_[voxel.above[axis]->state] : &scene_[axis];
  }

  /// The current states are those of the current voxel and of the lowest above it on the two other axes.
  void make_current(const Voxel& voxel) {
    current_ = &voxel;
    for (int axis = 0; axis < 3; ++axis)
      if (axis != voxel.axis && now_[axis]->voxel != voxel.above[axis]) now_[axis] = above(voxel, axis);
  }

  Grid1dVoxels<Real>& voxels_;
  TraversalStates<Real>& states_;
  const Ray<Real>& ray_;
  Crossings<Real> crossings_;
  Counter count_;
  const Reach& reach_;
  const Visit& visit_;
  Axis axes_[3];
  /// States for axes along which nothing around the ray is subdivided.
  State scene_[3]{};
  /// The current traversal states, the current voxel, and the parameter at which the ray came into its subvoxel.
  State* now_[3]{};
  const Voxel* current_ = nullptr;
  Real entered_ = 0;
  /// §5.2.2: on each axis, the lowest subdivided voxel around the ray when it moved last.
  const Voxel* comparison_[3]{};
};

}  // namespace rayshoot
