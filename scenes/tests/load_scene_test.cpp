#include "scenes/io/load_scene.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "scenes/io/mesh.h"
#include "scenes/io/nff.h"

namespace rayshoot {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

std::string refusal(const std::string& spec, std::optional<int> tessellation = {}) {
  try {
    return "accepted as " + load_scene(spec, tessellation).scene.id;
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(LoadScene, NamesScenesCanonically) {
  EXPECT_EQ(load_scene("balls").scene.id, "balls:4/curves");
  for (const char* spec : {"balls:2", "balls:2/curves", "balls(size=2)", "balls(form=curves,size=2)"})
    EXPECT_EQ(load_scene(spec).scene.id, "balls:2/curves") << spec;
  for (const char* spec :
       {"balls:1/patches", "balls(size=1,form=patches)", "balls:1/patches(tessellation=3)"})
    EXPECT_EQ(load_scene(spec).scene.id, "balls:1/patches") << spec;
  EXPECT_EQ(load_scene("balls(size=1,form=patches,tessellation=4)").scene.id,
            "balls:1/patches(tessellation=4)");
}

TEST(LoadScene, CanonicalIdsLoadTheSameScene) {
  for (const char* spec : {"balls:2", "balls(size=1,form=patches,tessellation=2)"}) {
    const Scene scene = load_scene(spec).scene;
    const Scene again = load_scene(scene.id).scene;
    EXPECT_EQ(again.id, scene.id);
    EXPECT_TRUE(same_content(again, scene));
  }
}

TEST(LoadScene, SaysWhereTheSceneComesFrom) {
  const LoadedScene loaded = load_scene("balls:2/patches");
  EXPECT_EQ(loaded.generator, "balls");
  EXPECT_EQ(loaded.size, 2);
  EXPECT_EQ(loaded.form, "patches");
  EXPECT_EQ(loaded.scene.size(), 1 + 91 * 108u);
}

TEST(LoadScene, TessellationStandsInWherePatchesNameNone) {
  EXPECT_EQ(load_scene("balls:1/patches", 2).scene.size(), 1 + 10 * 48u);
  EXPECT_EQ(load_scene("balls:1/patches(tessellation=1)", 2).scene.size(), 1 + 10 * 12u);
  EXPECT_EQ(load_scene("balls:1/curves", 2).scene.id, "balls:1/curves");
}

TEST(LoadScene, ReadsFilesByTheirEnding) {
  const Scene scene = load_scene("balls:1").scene;
  const std::string path = fmt::format("{}/rayshoot_load_{}.NFF", testing::TempDir(), ::getpid());
  write_nff(scene, path, kFullPrecision);
  const LoadedScene loaded = load_scene(path);
  std::filesystem::remove(path);
  EXPECT_TRUE(same_content(loaded.scene, scene));
  EXPECT_EQ(loaded.scene.id, path);
  EXPECT_EQ(loaded.generator + loaded.form, "");
  EXPECT_FALSE(loaded.size);
}

TEST(LoadScene, ReadsMeshFiles) {
  for (const char* ending : {"obj", "ply", "off", "stl"}) {
    const std::string path = fmt::format("{}/rayshoot_load_{}.{}", testing::TempDir(), ::getpid(), ending);
    write_mesh(load_scene("balls:1").scene, path);
    const LoadedScene loaded = load_scene(path);
    std::filesystem::remove(path);
    EXPECT_GE(loaded.scene.size(), 1 + 10 * 108u) << ending;
    EXPECT_EQ(loaded.scene.id, path);
  }
}

TEST(LoadScene, EveryGeneratorMakesAsManyObjectsAsItSays) {
  for (const SceneGenerator* generator : scene_generators())
    for (const char* form : {"curves", "patches"})
      for (int size = generator->min_size; size < generator->min_size + 3; ++size) {
        const LoadedScene loaded = load_scene(fmt::format("{}:{}/{}", generator->id, size, form));
        const SceneOptions options{.size = size,
                                   .form = loaded.form == "patches" ? SceneForm::patches : SceneForm::curves};
        EXPECT_EQ(generator->object_count(options, Arguments(generator->parameters, {}, "")),
                  loaded.scene.numbers())
            << loaded.scene.id;
        if (!generator->stored_objects) continue;
        std::size_t stored = loaded.scene.size();
        for (const Scene* part : distinct_parts(loaded.scene)) stored += part->size();
        EXPECT_EQ(generator->stored_objects(options, Arguments(generator->parameters, {}, "")), stored)
            << loaded.scene.id;
      }
}

TEST(LoadScene, RefusesUnknownNamesAndSaysWhatIsKnown) {
  EXPECT_THAT(refusal("bals"), AllOf(StartsWith("unknown scene 'bals'; did you mean 'balls'?"),
                                     HasSubstr("or a file ending in .nff .obj .ply .off .stl")));
  EXPECT_THAT(refusal("scene.obx"), AllOf(StartsWith("unknown scene 'scene.obx'"), HasSubstr(".obj")));
  EXPECT_THAT(refusal("balls(siz=2)"), HasSubstr("balls: unknown parameter 'siz'; did you mean 'size'?"));
  EXPECT_EQ(refusal("balls:2/patch"), "balls: form=patch is not accepted; form takes curves|patches");
}

TEST(LoadScene, RefusesSizesThatAreNone) {
  for (const char* size : {"0", "-1", "two", "2.5", "1e3", "99999999999999999999"})
    EXPECT_EQ(refusal(fmt::format("balls:{}", size)),
              fmt::format("balls: size={} is not accepted; size takes 1 to 1e+09", size));
  EXPECT_EQ(refusal("balls:2(size=2)"), "balls: the size is given twice");
  EXPECT_EQ(refusal("balls(form=curves)/curves"), "balls: the form is given twice");
}

TEST(LoadScene, RefusesTessellationsThatAreNoneOrUseless) {
  EXPECT_EQ(refusal("balls:1/patches(tessellation=0)"),
            "balls: tessellation=0 is not accepted; tessellation takes 1 to 1000");
  EXPECT_EQ(refusal("balls:1/patches", 0),
            "balls: tessellation=0 is not accepted; tessellation takes 1 to 1000");
  EXPECT_EQ(refusal("balls:1(tessellation=4)"),
            "balls: a tessellation goes with the form patches, as in balls/patches(tessellation=4)");
}

TEST(LoadScene, RefusesScenesThatCannotFit) {
  EXPECT_THAT(refusal("balls:10"),
              AllOf(StartsWith("balls:10/curves would have 3.92e+09 objects and need about 1.17e+03 GiB"),
                    HasSubstr("at most 536870912")));
  EXPECT_THAT(refusal("balls:1000000000"), HasSubstr("would have inf objects"));
  EXPECT_NO_THROW(check_object_count("scene", 1e6, 1e9));
  EXPECT_THAT([] { check_object_count("scene", 1e6, 2e8); },
              ThrowsMessage<InputError>(
                  "scene would have 1e+06 objects and need about 0.298 GiB; this machine has 0.186 GiB"));
}

TEST(LoadScene, TellsTheIdWithoutLoading) {
  EXPECT_EQ(scene_id("balls(size=2)"), "balls:2/curves");
  EXPECT_EQ(scene_id("balls:1/patches", 2), "balls:1/patches(tessellation=2)");
  EXPECT_THROW(scene_id("bals"), InputError);
  EXPECT_THROW(scene_id("balls:12"), InputError);
  EXPECT_THROW(scene_id("no/such/file.nff"), InputError);
}

TEST(LoadScene, NamesUnreadableFiles) {
  EXPECT_EQ(refusal("no/such/file.nff"), "cannot read no/such/file.nff: No such file or directory");
}

}  // namespace
}  // namespace rayshoot
