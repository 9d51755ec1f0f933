#pragma once

#include <functional>
#include <string>
#include <vector>

#include "accel/core/optimizer.h"

namespace rayshoot {

/// Objects in increasing order.
using Objects = std::vector<std::uint32_t>;
/// A(r, s) of an optimizer for some scene.
using CandidateSet = std::function<Objects(const Ray<double>&)>;

/// A voxel v of a spatial representation, with the objects that it meets.
struct VoxelContent {
  Box<double> box;
  Objects objects;
  /// Some rays that pass it by are shown it (optimizer.h), and those alone that meet the voxels around it.
  bool widened = false;
  std::vector<Box<double>> around{};
};
/// The representation m(s) that an index uses.
std::vector<VoxelContent> representation(const SpatialIndex<double>& index);

/// A law of Revelles and Ureña, held against many rays.
struct LawCheck {
  /// The equation, and what it says of the subject.
  std::string law;
  std::string subject;
  std::uint64_t rays = 0;
  /// The first ray that breaks it and the object that shows it, in a line; empty where the law holds.
  std::string violation{};

  bool holds() const { return violation.empty(); }
};

/// Holds what is given to it against the laws, on the rays that it was made with. What a ray meets it finds out by itself,
/// with a plain loop over the objects.
class Laws {
 public:
  Laws(const Geometry<double>& geometry, std::vector<Ray<double>> rays);

  /// (10): a strict optimizer has all objects that a ray meets, and none that is not in the scene.
  LawCheck strict_optimizer(const std::string& subject, const CandidateSet& candidates) const;
  /// (11): an optimizer has the nearest of them.
  LawCheck optimizer(const std::string& subject, const CandidateSet& candidates) const;
  /// (12): a spatial representation covers the scene: where a ray meets an object, a voxel holds that object.
  LawCheck covers(const std::string& subject, const std::vector<VoxelContent>& voxels) const;
  /// (13), (14): an optimizer based on spatial indexing has the objects of the voxels that the ray meets, and no others. A
  /// voxel that the ray touches within rounding may be met or not.
  LawCheck indexes_space(const std::string& subject, const CandidateSet& candidates,
                         const std::vector<VoxelContent>& voxels) const;
  /// (16), (17): a sequential composition has what its second part finds in the voxels of the first that the ray meets;
  /// `second` builds one over some of the objects.
  LawCheck sequential(const std::string& subject, const CandidateSet& composition,
                      const std::vector<VoxelContent>& voxels,
                      const std::function<CandidateSet(const Objects&)>& second) const;
  /// (18), (20): the two have the same candidates.
  LawCheck equal(const std::string& law, const std::string& subject, const CandidateSet& one,
                 const CandidateSet& other) const;
  /// (19): a parallel composition has the candidates that both its parts have.
  LawCheck parallel(const std::string& subject, const CandidateSet& composition, const CandidateSet& first,
                    const CandidateSet& second) const;

 private:
  struct Contact {
    std::uint32_t object;
    double t;
  };

  /// Where the claims are not true, what to say of the first ray.
  using Claim = std::function<std::string(std::size_t ray)>;
  LawCheck check(const std::string& law, const std::string& subject, const Claim& claim) const;
  Objects met(std::size_t ray) const;
  std::string within(const Objects& part, const char* part_name, const Objects& whole,
                     const char* whole_name) const;

  const Geometry<double>& geometry_;
  std::vector<Ray<double>> rays_;
  /// C(r, s) of each ray.
  std::vector<std::vector<Contact>> contacts_;
};

/// All the laws for a scene: of every technique, and of a set of expressions. `report` gets each check as it is made.
void check_laws(const Geometry<double>& geometry, const std::vector<Ray<double>>& rays,
                const std::function<void(const LawCheck&)>& report);

}  // namespace rayshoot
