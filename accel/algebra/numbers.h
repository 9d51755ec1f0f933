#pragma once

#include <unordered_map>

#include "accel/core/optimizer.h"

namespace rayshoot {

/// The numbers that objects have in a scene, by what they are called outside.
template <class Real>
class Numbers {
 public:
  explicit Numbers(const OptimizerInput<Real>& input) {
    for (std::uint32_t number = 0; number < input.names.size(); ++number)
      number_of_.emplace(input.names[number], number);
  }

  std::uint32_t operator()(std::uint32_t name) const {
    return number_of_.empty() ? name : number_of_.find(name)->second;
  }

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> number_of_;
};

}  // namespace rayshoot
