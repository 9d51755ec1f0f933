#include "accel/parts/grid_1d_voxels.h"

#include <cmath>
#include <numeric>
#include <random>

#include "scenes/geometry/ray.h"

namespace rayshoot {

namespace {

/// Without a sample so many random lines are traversed, for so many rays: a picture of the paper takes a million.
constexpr std::size_t kLines = 256;
constexpr double kRaysExpected = 1e6;
/// Storage: references below the root, by object and besides; and what memory a voxel costs, in references.
constexpr double kReferencesPerObject = 160, kSpareReferences = 1 << 18;
constexpr std::size_t kCacheLine = 64;
/// A sample ray is not tested against more objects than this in one voxel.
constexpr std::uint32_t kMostSampleTests = 256;

template <class Real>
double storage_of(int granularity) {
  const std::size_t bytes =
      SubdividedVoxel<Real>::bytes(static_cast<std::size_t>(granularity)) + sizeof(VoxelContext<Real>);
  return static_cast<double>(bytes) / sizeof(std::uint32_t);
}

/// Lines through two points of the sphere around a box meet every convex body in it in proportion to its surface.
template <class Real>
std::vector<Ray<Real>> random_lines(const Box<Real>& box) {
  std::mt19937_64 generator(1);
  const auto coordinate = [&] { return std::ldexp(static_cast<double>(generator() >> 11), -52) - 1; };
  const auto on_sphere = [&] {
    for (;;) {
      const Vec3d p{coordinate(), coordinate(), coordinate()};
      if (dot(p, p) <= 1 && dot(p, p) > 1e-4) return normalized(p);
    }
  };
  const Vec3d centre = Vec3d(box.lo) * 0.5 + Vec3d(box.hi) * 0.5, half = Vec3d(box.hi) - centre;
  const double radius = 1.01 * length(half);
  std::vector<Ray<Real>> lines;
  for (std::size_t i = 0; i < kLines; ++i) {
    const Vec3d from = on_sphere(), to = on_sphere();
    lines.push_back({.origin = Vec3<Real>(centre + radius * from), .direction = Vec3<Real>(to - from)});
  }
  return lines;
}

template <class Real>
bool passes(const Ray<Real>& ray, const Box<Real>& box) {
  const Interval<Real> inside = Crossings<Real>(ray).inside(box);
  return inside.enter <= inside.exit && inside.exit > ray.t_min && inside.enter <= ray.t_max;
}

}  // namespace

template <class Real>
Grid1dVoxels<Real>::Grid1dVoxels(const Geometry<Real>& geometry, const RaySample<Real>& sample,
                                 const Grid1dRules& rules)
    : geometry_(geometry), rules_(rules) {
  if (geometry.size() == 0) return;
  const Box<Real>& box = geometry.bounds();
  apart_ =
      std::max(padding(std::max(max_abs(box.lo), max_abs(box.hi)), 16), std::numeric_limits<Real>::min());
  const auto meets = [&](const Ray<Real>& ray) { return passes(ray, box); };
  if (std::any_of(sample.rays.begin(), sample.rays.end(), meets))
    traverse_breadth_first({sample.rays.begin(), sample.rays.end()}, sample.rays_each, true);
  else
    traverse_breadth_first(random_lines(box), kRaysExpected / kLines, false);
}

/// §6.5. Rays that are `occluded` go no further than the nearest hit that is known.
template <class Real>
void Grid1dVoxels<Real>::traverse_breadth_first(std::vector<Ray<Real>> rays, double rays_each,
                                                bool occluded) {
  // Begin with the voxel of the whole scene and all objects.
  Candidate root{.slot = &root_, .list = new_list(geometry_.size()), .box = box()};
  std::uint32_t* list = const_cast<std::uint32_t*>(root.list);
  std::iota(list + 1, list + 1 + geometry_.size(), 0u);
  root.spare_references = kReferencesPerObject * geometry_.size() + kSpareReferences;
  for (std::uint32_t ray = 0; ray < rays.size(); ++ray)
    if (passes(rays[ray], root.box)) root.sample.push_back(ray);
  root.estimated_num_rays = rays_each * static_cast<double>(root.sample.size());

  for (std::vector<Candidate> level{std::move(root)}; !level.empty();) {
    // Subdivide the voxels of a level; where one stays whole, its rays meet its objects.
    for (const Candidate& candidate : level) {
      candidate.slot->publish(subdivide(candidate));
      if (occluded && !candidate.slot->read().subdivided()) end_at_hits(candidate, rays);
    }
    // Their subvoxels are the next level, as far as rays come to them.
    std::vector<Candidate> next;
    for (const Candidate& candidate : level)
      if (candidate.slot->read().subdivided()) hand_down(candidate, rays, rays_each, next);
    level = std::move(next);
  }
}

template <class Real>
void Grid1dVoxels<Real>::end_at_hits(const Candidate& leaf, std::vector<Ray<Real>>& rays) const {
  if (leaf.objects().size() > kMostSampleTests) return;
  for (const std::uint32_t ray : leaf.sample)
    for (const std::uint32_t object : leaf.objects())
      rays[ray].t_max = std::min(rays[ray].t_max, geometry_.hit_distance(object, rays[ray]));
}

template <class Real>
void Grid1dVoxels<Real>::hand_down(const Candidate& from, const std::vector<Ray<Real>>& rays,
                                   double rays_each, std::vector<Candidate>& children) {
  const Voxel& voxel = *from.slot->read().voxel();
  for (std::uint32_t index = 0; index < voxel.granularity; ++index) {
    if (!voxel.subvoxels()[index].read().undecided()) continue;
    Candidate child = subvoxel_of(voxel, index);
    for (const std::uint32_t ray : from.sample)
      if (passes(rays[ray], child.box)) child.sample.push_back(ray);
    if (child.sample.empty()) continue;
    child.estimated_num_rays = rays_each * static_cast<double>(child.sample.size());
    children.push_back(std::move(child));
  }
}

/// An undecided subvoxel. Where no sample goes through it, rays are estimated by its share of the parent's surface.
template <class Real>
typename Grid1dVoxels<Real>::Candidate Grid1dVoxels<Real>::subvoxel_of(const Voxel& parent,
                                                                       std::uint32_t index) const {
  auto& slot = const_cast<Subvoxel<Real>&>(parent.subvoxels()[index]);
  const VoxelContext<Real>& context = *parent.context;
  Candidate child{.slot = &slot,
                  .parent = &parent,
                  .list = slot.read().list(),
                  .box = context.box,
                  .numbers = context.numbers};
  child.box.lo[parent.axis] = parent.planes()[index];
  child.box.hi[parent.axis] = parent.planes()[index + 1];
  child.numbers[parent.axis] = parent.first + index;
  const double surface = context.box.surface_area();
  child.estimated_num_rays =
      context.estimated_num_rays * (surface > 0 ? child.box.surface_area() / surface : 1);
  child.spare_references =
      context.spare_references * static_cast<double>(*child.list) / static_cast<double>(context.references);
  return child;
}

template <class Real>
typename Grid1dVoxels<Real>::Content Grid1dVoxels<Real>::decide(const Voxel& parent, std::uint32_t index) {
  const std::lock_guard lock(mutex_);
  if (!parent.subvoxels()[index].read().undecided()) return parent.subvoxels()[index].read();
  const Candidate candidate = subvoxel_of(parent, index);
  candidate.slot->publish(subdivide(candidate));
  return candidate.slot->read();
}

/// Create the array of subvoxels and sort the objects into it (§4.1), if that pays and storage suffices.
template <class Real>
typename Grid1dVoxels<Real>::Content Grid1dVoxels<Real>::subdivide(const Candidate& candidate) {
  const Cut cut = choose_cut(candidate);
  VoxelContext<Real> context{
      .parent = candidate.parent,
      .box = candidate.box,
      .absolute_granularity = absolute_granularity(candidate, cut),
      .numbers = candidate.numbers,
      .estimated_num_rays = candidate.estimated_num_rays,
      .spare_references = candidate.spare_references - storage_of<Real>(cut.granularity)};
  const bool affordable = context.spare_references >= static_cast<double>(candidate.objects().size());
  if (cut.granularity < 2 || !affordable) return Content::leaf(candidate.list);
  Voxel* voxel = new_voxel(candidate, cut, context.absolute_granularity);
  if (!sort_objects(candidate, *voxel, context)) return Content::leaf(candidate.list);
  voxel->context = new (allocate(sizeof(context))) VoxelContext<Real>(context);
  return Content::subdivided(voxel);
}

/// The granularity that the cost function finds cheapest, on the axis of the voxel's depth or the next that pays.
template <class Real>
typename Grid1dVoxels<Real>::Cut Grid1dVoxels<Real>::choose_cut(const Candidate& candidate) const {
  const Vec3d size = Vec3d(candidate.box.hi) - Vec3d(candidate.box.lo), mean_size = mean_sizes(candidate);
  const Vec3d area{size.y * size.z, size.z * size.x, size.x * size.y};
  const double sum = area.x + area.y + area.z;
  const int first_axis = candidate.parent ? (candidate.parent->axis + 1) % 3 : 0;
  for (int turn = 0; turn < 3; ++turn) {
    const int axis = (first_axis + turn) % 3;
    if (!separable(candidate, {axis, 2})) continue;
    const double across = sum > 0 ? area[axis] / sum : 1.0 / 3;
    const SubdivisionCandidate costed{.num_objects = static_cast<double>(candidate.objects().size()),
                                      .mean_object_size = mean_size[axis],
                                      .voxel_size = size[axis],
                                      .area_beside = 1 - across,
                                      .area_across = across,
                                      .estimated_num_rays = candidate.estimated_num_rays};
    const Cut cut{axis, cheapest_granularity(rules_.timings, costed, rules_.maximum_granularity)};
    if (cut.granularity > 1 && separable(candidate, cut)) return cut;
    if (rules_.axes == AxisRule::alternate) break;
  }
  return {};
}

/// Of the objects along the three axes, truncated to the voxel (§6.3).
template <class Real>
Vec3d Grid1dVoxels<Real>::mean_sizes(const Candidate& candidate) const {
  Vec3d sum;
  for (const std::uint32_t object : candidate.objects()) {
    const Box<Real> bounds = geometry_.bounds(object);
    sum += Vec3d(min(bounds.hi, candidate.box.hi)) - Vec3d(max(bounds.lo, candidate.box.lo));
  }
  return sum * (1.0 / static_cast<double>(candidate.objects().size()));
}

template <class Real>
std::uint64_t Grid1dVoxels<Real>::absolute_granularity(const Candidate& candidate, const Cut& cut) const {
  const Voxel* above = candidate.above(cut.axis);
  return (above ? above->context->absolute_granularity : 1) * static_cast<std::uint64_t>(cut.granularity);
}

/// Whether the planes of a cut can be told apart, and counted.
template <class Real>
bool Grid1dVoxels<Real>::separable(const Candidate& candidate, const Cut& cut) const {
  const Real size = candidate.box.hi[cut.axis] - candidate.box.lo[cut.axis];
  return size / static_cast<Real>(cut.granularity) >= apart_ &&
         absolute_granularity(candidate, cut) < std::uint64_t{1} << 52;
}

/// A voxel with its planes in place, and nothing in its subvoxels.
template <class Real>
SubdividedVoxel<Real>* Grid1dVoxels<Real>::new_voxel(const Candidate& candidate, const Cut& cut,
                                                     std::uint64_t absolute) {
  const auto granularity = static_cast<std::uint32_t>(cut.granularity);
  auto* voxel = new (allocate(Voxel::bytes(granularity), kCacheLine)) Voxel;
  for (int axis = 0; axis < 3; ++axis) voxel->above[axis] = candidate.above(axis);
  voxel->axis = cut.axis;
  voxel->granularity = granularity;
  voxel->first = candidate.numbers[cut.axis] * granularity;
  voxel->state = states_.find(cut.axis, absolute);
  const double length = static_cast<double>(box().hi[cut.axis]) - static_cast<double>(box().lo[cut.axis]);
  voxel->subvoxels_per_length = static_cast<Real>(static_cast<double>(absolute) / length);
  auto* subvoxels = reinterpret_cast<Subvoxel<Real>*>(voxel + 1);
  auto* planes = reinterpret_cast<Real*>(subvoxels + granularity);
  for (std::uint32_t k = 0; k < granularity; ++k) new (&subvoxels[k]) Subvoxel<Real>;
  for (std::uint32_t k = 0; k <= granularity; ++k)
    new (&planes[k]) Real(subdivision_plane(box(), cut.axis, voxel->first + k, absolute));
  return voxel;
}

/// Sort the objects of a voxel into its subvoxels; false where storage does not suffice.
template <class Real>
bool Grid1dVoxels<Real>::sort_objects(const Candidate& candidate, Voxel& voxel, VoxelContext<Real>& context) {
  // Count what each gets.
  std::vector<Range> ranges;
  std::vector<std::uint32_t> counts(voxel.granularity, 0);
  ranges.reserve(candidate.objects().size());
  for (const std::uint32_t object : candidate.objects()) {
    ranges.push_back(range_of(object, voxel));
    for (std::uint32_t k = ranges.back().first; k <= ranges.back().last; ++k) ++counts[k];
  }
  context.references = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  context.spare_references -= static_cast<double>(context.references);
  if (context.spare_references < 0) return false;

  // Write their lists.
  std::vector<std::uint32_t*> lists(voxel.granularity, nullptr);
  auto* subvoxels = reinterpret_cast<Subvoxel<Real>*>(&voxel + 1);
  for (std::uint32_t k = 0; k < voxel.granularity; ++k) {
    if (counts[k] == 0) continue;
    std::uint32_t* list = new_list(counts[k]);
    subvoxels[k].publish(Content::undecided(list));
    lists[k] = list + 1;
  }
  for (std::size_t i = 0; i < ranges.size(); ++i)
    for (std::uint32_t k = ranges[i].first; k <= ranges[i].last; ++k) *lists[k]++ = candidate.objects()[i];
  return true;
}

/// The subvoxels that share a point with the object's bounds, all taken as closed.
template <class Real>
typename Grid1dVoxels<Real>::Range Grid1dVoxels<Real>::range_of(std::uint32_t object,
                                                                const Voxel& voxel) const {
  const Box<Real> bounds = geometry_.bounds(object);
  const Real* planes = voxel.planes();
  const Real lo = bounds.lo[voxel.axis], hi = bounds.hi[voxel.axis];
  const Real near = (lo - planes[0]) * voxel.subvoxels_per_length;
  std::uint32_t first =
      near > 0 ? static_cast<std::uint32_t>(std::min(near, static_cast<Real>(voxel.granularity - 1))) : 0;
  while (first > 0 && planes[first] >= lo) --first;
  while (first + 1 < voxel.granularity && planes[first + 1] < lo) ++first;
  std::uint32_t last = first;
  while (last + 1 < voxel.granularity && planes[last + 1] <= hi) ++last;
  return {first, last};
}

template <class Real>
StructureStats Grid1dVoxels<Real>::structure() const {
  const std::lock_guard lock(mutex_);
  StructureStats stats{.bytes = bytes_ + states_.bytes() + sizeof(*this)};
  double& subdivided = stats.figures["voxels_subdivided"] = 0;
  stats.figures["candidates_untouched"] = 0;
  add(root(), 0, stats);
  const double created = states_.created();
  stats.figures["traversal_states_created"] = created;
  stats.figures["traversal_states_saved_percent"] = subdivided > 0 ? 100 * (1 - created / subdivided) : 0;
  return stats;
}

template <class Real>
void Grid1dVoxels<Real>::add(const Content& content, std::uint64_t depth, StructureStats& stats) const {
  ++stats.nodes;
  stats.max_depth = std::max(stats.max_depth, depth);
  if (!content.subdivided()) {
    ++stats.leaves;
    stats.empty_leaves += content.objects().empty();
    stats.references += content.objects().size();
    if (content.undecided()) ++stats.figures["candidates_untouched"];
    return;
  }
  ++stats.figures["voxels_subdivided"];
  const Voxel& voxel = *content.voxel();
  for (std::uint32_t k = 0; k < voxel.granularity; ++k) add(voxel.subvoxels()[k].read(), depth + 1, stats);
}

template <class Real>
std::uint32_t* Grid1dVoxels<Real>::new_list(std::uint32_t objects) {
  auto* list = new (allocate((std::size_t{objects} + 1) * sizeof(std::uint32_t))) std::uint32_t[objects + 1];
  *list = objects;
  return list;
}

/// Memory for good, in blocks that grow with what there is.
template <class Real>
std::byte* Grid1dVoxels<Real>::allocate(std::size_t bytes, std::size_t alignment) {
  bytes = (bytes + 7) / 8 * 8;
  void* at = free_;
  if (!std::align(alignment, bytes, at, free_bytes_)) {
    free_bytes_ = std::max(bytes + alignment, std::clamp<std::size_t>(bytes_ / 2, 1 << 12, 1 << 22));
    blocks_.push_back(std::unique_ptr<std::byte[]>(new std::byte[free_bytes_]));
    bytes_ += free_bytes_;
    at = blocks_.back().get();
    std::align(alignment, bytes, at, free_bytes_);
  }
  free_ = static_cast<std::byte*>(at) + bytes;
  free_bytes_ -= bytes;
  return static_cast<std::byte*>(at);
}

template class Grid1dVoxels<float>;
template class Grid1dVoxels<double>;

}  // namespace rayshoot
