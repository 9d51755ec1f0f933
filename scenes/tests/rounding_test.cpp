// What the build must not do to arithmetic, or answers depend on how code was inlined.
#include <gtest/gtest.h>

#include <array>

namespace {

/// GCC 12 keeps the digits that rounding drops, where it packs both conversions into vectors.
[[gnu::noipa]] std::array<double, 2> rounded_to_float(const std::array<double, 2>& pair) {
  const std::array rounded{static_cast<float>(pair[0]), static_cast<float>(pair[1])};
  return {rounded[0], rounded[1]};
}

[[gnu::noipa]] double product_plus(double a, double b, double c) { return a * b + c; }

/// GCC 12 fuses the pair into one instruction even where contraction is off.
[[gnu::noipa]] std::array<double, 2> product_minus_and_plus(const std::array<double, 2>& a,
                                                            const std::array<double, 2>& b,
                                                            const std::array<double, 2>& c) {
  return {a[0] * b[0] - c[0], a[1] * b[1] + c[1]};
}

TEST(Rounding, ToFloatSurvivesTheWayBackToDouble) {
  constexpr double third = 1.0 / 3, rounded = 0x1.555556p-2;
  EXPECT_EQ(rounded_to_float({third, third}), (std::array{rounded, rounded}));
}

TEST(Rounding, OfAProductComesBeforeTheSum) {
  constexpr double a = 1 + 0x1p-30;
  EXPECT_EQ(product_plus(a, a, -1 - 0x1p-29), 0) << "a fused operation leaves 2^-60";
  EXPECT_EQ(product_minus_and_plus({a, a}, {a, a}, {1 + 0x1p-29, -1 - 0x1p-29}), (std::array{0.0, 0.0}));
}

}  // namespace
