#include "accel/tests/scene_conformance.h"

namespace rayshoot {
namespace {

class SceneConformance : public ::testing::TestWithParam<const SceneGenerator*> {};

TEST_P(SceneConformance, EveryTechniqueEqualsExhaustiveSearchOnCurves) {
  conformance::check_scene(*GetParam(), SceneForm::curves, technique_entries());
}

TEST_P(SceneConformance, EveryTechniqueEqualsExhaustiveSearchOnPatches) {
  conformance::check_scene(*GetParam(), SceneForm::patches, technique_entries());
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneConformance, conformance::every_scene(), conformance::scene_name);

}  // namespace
}  // namespace rayshoot
