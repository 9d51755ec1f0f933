#pragma once

#include <gmock/gmock.h>

#include "accel/tests/built_engine.h"

/// The two caveats of spatial subdivision (Arvo & Kirk §5.3, Figure 16), for every technique with voxels.
namespace rayshoot::caveats {

/// A box from 0 to 8 on all axes, of which each voxel is two long where it is cut into four. The ray runs along x
/// through the lowest of them. `slope` comes down through all of them and is hit in the third; `post` stands in the
/// second, before that hit. The others hold the corners of the box.
enum Object : std::uint32_t { slope, post, low_corner, high_corner };

inline Scene scene() {
  SceneBuilder builder;
  nasty::square(builder, {1, 1.9, 0.1}, {6, -1.8, 0}, {0, 0, 0.8});
  nasty::square(builder, {3, 0.3, 0.3}, {0, 0.4, 0}, {0, 0, 0.4});
  builder.sphere({0.05, 0.05, 0.05}, 0.05);
  builder.sphere({7.95, 7.95, 7.95}, 0.05);
  return std::move(builder).finish();
}

inline constexpr Ray<double> kAlongX{.origin = {0.5, 0.5, 0.5}, .direction = {1, 0, 0}};
inline constexpr double kPostDistance = 2.5;

/// Not to test an object again in every voxel in which it is listed: with a mailbox each object is tested once, and
/// what is not tested again is counted.
inline void check_repeated_tests(const char* id, Given given) {
  const Geometry<double> geometry(scene());
  const auto work = [&](const char* mailbox, Query query) {
    given["mailbox"] = mailbox;
    return counted(*build(id, geometry, given), query, {kAlongX}).work;
  };
  for (const Query query : {Query::closest, Query::strict}) {
    const Work off = work("off", query), on = work("on", query);
    EXPECT_GT(off.object_tests, off.distinct_objects);
    EXPECT_EQ(off.mailbox_hits, 0u);
    EXPECT_EQ(on.object_tests, on.distinct_objects);
    EXPECT_EQ(on.object_tests + on.mailbox_hits, off.object_tests);
    EXPECT_EQ(on.distinct_objects, off.distinct_objects);
    EXPECT_EQ(on.cells, off.cells);
    EXPECT_EQ(work("auto", query), on) << "the slope is listed more than once";
  }
}

/// A mailbox changes no answer, on many rays and one after the other.
inline void check_mailbox_changes_no_answer(const char* id, Given given) {
  const Scene soup = soup_scene(300);
  const Geometry<double> geometry(soup);
  const auto rays = nasty::rays(geometry, 1, 200);
  const auto result = [&](const char* mailbox, Query query) {
    given["mailbox"] = mailbox;
    return counted(*build(id, geometry, given), query, rays);
  };
  for (const Query query : {Query::closest, Query::any, Query::strict}) {
    const Counted<double> off = result("off", query), on = result("on", query),
                          automatic = result("auto", query);
    EXPECT_EQ(on.hits, off.hits);
    EXPECT_LT(on.work.object_tests, off.work.object_tests);
    EXPECT_EQ(on.work.object_tests, on.work.distinct_objects);
    EXPECT_EQ(automatic.hits, off.hits);
    EXPECT_EQ(automatic.work, on.work);
  }
}

/// A hit beyond the current voxel must not end the walk: in the first voxel the ray finds the slope, and hits it far
/// beyond the post. A hit inside of the current voxel must end it.
inline void check_hit_beyond_the_voxel(const char* id, Given given, std::uint64_t voxels_on_ray) {
  const Geometry<double> geometry(scene());
  ASSERT_GT(geometry.hit_distance(slope, kAlongX), 4);
  ASSERT_LT(geometry.hit_distance(slope, kAlongX), 6);
  for (const char* mailbox : {"on", "off"}) {
    given["mailbox"] = mailbox;
    const auto engine = build(id, geometry, given);
    Ray<double> within_first_voxel = kAlongX;
    within_first_voxel.t_max = 1;
    const auto first = candidates(*engine, Query::closest, within_first_voxel);
    EXPECT_THAT(first, ::testing::Contains(slope));
    EXPECT_THAT(first, ::testing::Not(::testing::Contains(post)));

    const Counted<double> closest = counted(*engine, Query::closest, {kAlongX});
    EXPECT_EQ(closest.hits[0], (Hit<double>{kPostDistance, post}));
    EXPECT_EQ(closest.work.cells, 2u);
    EXPECT_EQ(counted(*engine, Query::strict, {kAlongX}).work.cells, voxels_on_ray);
  }
}

}  // namespace rayshoot::caveats
