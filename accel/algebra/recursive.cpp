// Recursive optimizers (Revelles & Ureña 1999, §5.3, equation 20)
//
// Idea       A = B|A: each voxel of B is divided by another B, until a scene is small or the depth is reached. An octree is a
//            grid of 2×2×2 voxels composed with itself, a binary tree one of two voxels; here any technique can be.
// Parameters until (8): a scene with at most so many objects is a plain list; max_depth (6): divisions above a list at the
//            most, which bounds the memory that large objects in many voxels take; box, as of `|`, but the whole voxel, so
//            that the cells of a recursive grid are those of the octree.
// Cost       That of B at every level; a structure of its own for every voxel that is divided is dear to build.
// Weak       Wherever somebody wrote the same recursion as one structure.

#include "accel/algebra/recursive.h"

#include "accel/algebra/list.h"

namespace rayshoot {

std::vector<Parameter> recursive_parameters() {
  const RecursiveConfig defaults;
  std::vector<Parameter> parameters = sequential_parameters(defaults.division);
  parameters.push_back(
      integer_parameter("max_depth", defaults.max_depth, 0, 32, "divisions above a plain list at the most"));
  return parameters;
}

RecursiveConfig recursive_config(const Arguments& arguments) {
  return {sequential_config(arguments), static_cast<int>(arguments.integer("max_depth"))};
}

template <class Real>
std::unique_ptr<Optimizer<Real>> recursive(const OptimizerInput<Real>& input, const BuildPart<Real>& part,
                                           const RecursiveConfig& config) {
  if (config.max_depth == 0 || input.geometry.size() <= config.division.until)
    return std::make_unique<List<Real>>(input);
  RecursiveConfig deeper = config;
  --deeper.max_depth;
  const BuildPart<Real> again = [&](const OptimizerInput<Real>& voxel) {
    return recursive(voxel, part, deeper);
  };
  return sequential(input, part, again, config.division);
}

template std::unique_ptr<Optimizer<float>> recursive(const OptimizerInput<float>&, const BuildPart<float>&,
                                                     const RecursiveConfig&);
template std::unique_ptr<Optimizer<double>> recursive(const OptimizerInput<double>&, const BuildPart<double>&,
                                                      const RecursiveConfig&);

}  // namespace rayshoot
