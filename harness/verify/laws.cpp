#include "harness/verify/laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace rayshoot {

namespace {

std::string describe(const Ray<double>& ray) {
  return fmt::format("ray from ({}, {}, {}) along ({}, {}, {}) over ({}, {}]", ray.origin.x, ray.origin.y,
                     ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z, ray.t_min, ray.t_max);
}

/// How a ray and a voxel lie to each other, as far as rounding lets one say.
enum class Meeting { none, touches, passes };

Meeting meeting(const Ray<double>& ray, const Box<double>& box) {
  const Interval<double> inside = interval_inside(box, ray);
  const double enter = std::max(inside.enter, std::max(ray.t_min, 0.0)),
               exit = std::min(inside.exit, ray.t_max);
  if (!(enter <= exit)) return Meeting::none;
  bool along_wall = false;
  for (int axis = 0; axis < 3; ++axis)
    along_wall |=
        ray.direction[axis] == 0 && !(box.lo[axis] < ray.origin[axis] && ray.origin[axis] < box.hi[axis]);
  return !along_wall && enter * kApart<double> < exit ? Meeting::passes : Meeting::touches;
}

Meeting meeting(const Ray<double>& ray, const VoxelContent& voxel) {
  Meeting how = meeting(ray, voxel.box);
  if (voxel.widened) how = std::max(how, Meeting::touches);
  for (const Box<double>& box : voxel.around) how = std::min(how, meeting(ray, box));
  return how;
}

/// The objects that `of_voxel` has in the voxels that the ray passes, and in those that it touches besides.
struct OnRay {
  Objects certain, possible;
};

template <class OfVoxel>
OnRay on_ray(const Ray<double>& ray, const std::vector<VoxelContent>& voxels, const OfVoxel& of_voxel) {
  OnRay found;
  for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel) {
    const Meeting how = meeting(ray, voxels[voxel]);
    if (how == Meeting::none) continue;
    const Objects objects = of_voxel(voxel);
    found.possible.insert(found.possible.end(), objects.begin(), objects.end());
    if (how == Meeting::passes) found.certain.insert(found.certain.end(), objects.begin(), objects.end());
  }
  for (Objects* objects : {&found.certain, &found.possible}) {
    std::sort(objects->begin(), objects->end());
    objects->erase(std::unique(objects->begin(), objects->end()), objects->end());
  }
  return found;
}

}  // namespace

std::vector<VoxelContent> representation(const SpatialIndex<double>& index) {
  std::vector<VoxelContent> voxels;
  index.for_each_voxel([&](const Voxel<double>& voxel) {
    voxels.push_back({voxel.box, {voxel.objects.begin(), voxel.objects.end()}, voxel.widened, voxel.around});
    std::sort(voxels.back().objects.begin(), voxels.back().objects.end());
  });
  return voxels;
}

Laws::Laws(const Geometry<double>& geometry, std::vector<Ray<double>> rays)
    : geometry_(geometry), rays_(std::move(rays)), contacts_(rays_.size()) {
  for (std::size_t ray = 0; ray < rays_.size(); ++ray)
    for (std::uint32_t object = 0; object < geometry.size(); ++object)
      if (const double t = geometry.hit_distance(object, rays_[ray]); t != kMiss<double>)
        contacts_[ray].push_back({object, t});
}

LawCheck Laws::check(const std::string& law, const std::string& subject, const Claim& claim) const {
  LawCheck check{.law = law, .subject = subject, .rays = rays_.size()};
  for (std::size_t ray = 0; ray < rays_.size() && check.holds(); ++ray)
    if (const std::string wrong = claim(ray); !wrong.empty())
      check.violation = fmt::format("{}: {}", describe(rays_[ray]), wrong);
  return check;
}

Objects Laws::met(std::size_t ray) const {
  Objects objects;
  for (const Contact& contact : contacts_[ray]) objects.push_back(contact.object);
  return objects;
}

std::string Laws::within(const Objects& part, const char* part_name, const Objects& whole,
                         const char* whole_name) const {
  Objects missing;
  std::set_difference(part.begin(), part.end(), whole.begin(), whole.end(), std::back_inserter(missing));
  return missing.empty() ? ""
                         : fmt::format("object {} is in {} but not in {}", missing[0], part_name, whole_name);
}

LawCheck Laws::strict_optimizer(const std::string& subject, const CandidateSet& candidates) const {
  return check("(10) strict optimizer", subject, [&](std::size_t ray) {
    const Objects of_ray = candidates(rays_[ray]);
    if (!of_ray.empty() && of_ray.back() >= geometry_.size())
      return fmt::format("object {} is in A but not in the scene", of_ray.back());
    return within(met(ray), "C", of_ray, "A");
  });
}

LawCheck Laws::optimizer(const std::string& subject, const CandidateSet& candidates) const {
  return check("(11) optimizer", subject, [&](std::size_t ray) {
    const auto nearest = std::min_element(contacts_[ray].begin(), contacts_[ray].end(),
                                          [](const Contact& a, const Contact& b) { return a.t < b.t; });
    if (nearest == contacts_[ray].end()) return std::string();
    Objects all_nearest;
    for (const Contact& contact : contacts_[ray])
      if (contact.t == nearest->t) all_nearest.push_back(contact.object);
    return within(all_nearest, "Cn", candidates(rays_[ray]), "A+");
  });
}

LawCheck Laws::covers(const std::string& subject, const std::vector<VoxelContent>& voxels) const {
  return check("(12) covers the scene", subject, [&](std::size_t ray) {
    for (const Contact& contact : contacts_[ray]) {
      const auto holds = [&](const VoxelContent& voxel) {
        const Interval<double> inside = interval_inside(voxel.box, rays_[ray]);
        return inside.enter <= contact.t && contact.t <= inside.exit &&
               std::binary_search(voxel.objects.begin(), voxel.objects.end(), contact.object);
      };
      if (std::none_of(voxels.begin(), voxels.end(), holds))
        return fmt::format("object {} is met at {}, where no voxel holds it", contact.object, contact.t);
    }
    return std::string();
  });
}

LawCheck Laws::indexes_space(const std::string& subject, const CandidateSet& candidates,
                             const std::vector<VoxelContent>& voxels) const {
  return check("(14) A(r,s) = psi(r,s,m(s))", subject, [&](std::size_t ray) {
    const OnRay psi = on_ray(rays_[ray], voxels, [&](std::size_t voxel) { return voxels[voxel].objects; });
    const Objects of_ray = candidates(rays_[ray]);
    const std::string missing = within(psi.certain, "psi", of_ray, "A");
    return missing.empty() ? within(of_ray, "A", psi.possible, "psi") : missing;
  });
}

LawCheck Laws::sequential(const std::string& subject, const CandidateSet& composition,
                          const std::vector<VoxelContent>& voxels,
                          const std::function<CandidateSet(const Objects&)>& second) const {
  std::vector<CandidateSet> inside;
  for (const VoxelContent& voxel : voxels) inside.push_back(second(voxel.objects));
  return check("(16) union of A2(r,e)", subject, [&](std::size_t ray) {
    const OnRay all =
        on_ray(rays_[ray], voxels, [&](std::size_t voxel) { return inside[voxel](rays_[ray]); });
    const Objects of_ray = composition(rays_[ray]);
    const std::string missing = within(all.certain, "the union", of_ray, "A1|A2");
    return missing.empty() ? within(of_ray, "A1|A2", all.possible, "the union") : missing;
  });
}

LawCheck Laws::equal(const std::string& law, const std::string& subject, const CandidateSet& one,
                     const CandidateSet& other) const {
  return check(law, subject, [&](std::size_t ray) {
    const Objects left = one(rays_[ray]), right = other(rays_[ray]);
    const std::string missing = within(left, "the left side", right, "the right side");
    return missing.empty() ? within(right, "the right side", left, "the left side") : missing;
  });
}

LawCheck Laws::parallel(const std::string& subject, const CandidateSet& composition,
                        const CandidateSet& first, const CandidateSet& second) const {
  return check("(19) A1||A2 = both", subject, [&](std::size_t ray) {
    const Objects of_first = first(rays_[ray]), of_second = second(rays_[ray]),
                  of_ray = composition(rays_[ray]);
    Objects both;
    std::set_intersection(of_first.begin(), of_first.end(), of_second.begin(), of_second.end(),
                          std::back_inserter(both));
    const std::string missing = within(both, "both", of_ray, "A1||A2");
    return missing.empty() ? within(of_ray, "A1||A2", both, "both") : missing;
  });
}

}  // namespace rayshoot
