#include "accel/parts/wide_avx2.h"
#include "accel/parts/wide_search.h"

namespace rayshoot {

const WideKernels kWideKernelsAvx2{"avx2", WideSearch<WideAvx2>::closest_of_all,
                                   WideSearch<WideAvx2>::any_of_all};

bool are_coherent(std::span<const Ray<float>> rays) {
  const std::size_t stride = std::max<std::size_t>(rays.size() / 64, 1);
  std::size_t pairs = 0, alike = 0;
  for (std::size_t i = 1; i < rays.size(); i += stride, ++pairs) {
    const Vec3<float>&a = rays[i - 1].direction, &b = rays[i].direction;
    alike += 100 * dot(a - b, a - b) < dot(a, a);
  }
  return 4 * alike > 3 * pairs;
}

float other_hit_distance(const WideScene& scene, std::uint32_t place, Ray<float> ray, float reach) {
  ray.t_max = reach;
  return scene.geometry.hit_distance(scene.order[place], ray);
}

bool has_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
}

}  // namespace rayshoot
