#include "harness/baseline/embree_scene.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>
#include <new>
#include <stdexcept>
#include <string_view>

#include "harness/baseline/baselines.h"

namespace rayshoot {

namespace {

/// Bytes that Embree holds at the moment, over all scenes.
std::atomic<std::int64_t> live_bytes = 0;

bool watch_memory(void*, ssize_t bytes, bool) {
  live_bytes += bytes;
  return true;
}

RTCDevice new_device() {
  const RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr)
    throw std::runtime_error(
        fmt::format("Embree does not run here (error {})", static_cast<int>(rtcGetDeviceError(nullptr))));
  rtcSetDeviceMemoryMonitorFunction(device, watch_memory, nullptr);
  return device;
}

/// Throw what the last call on this thread left behind.
void check() {
  const RTCError error = rtcGetDeviceError(embree_device());
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(fmt::format("Embree failed (error {})", static_cast<int>(error)));
}

}  // namespace

RTCDevice embree_device() {
  static const RTCDevice device = new_device();
  return device;
}

std::string embree_version() {
  const auto number = [](RTCDeviceProperty property) {
    return rtcGetDeviceProperty(embree_device(), property);
  };
  return fmt::format("{}.{}.{}", number(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                     number(RTC_DEVICE_PROPERTY_VERSION_MINOR), number(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

bool embree_has_assertions() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<void*>(rtcNewDevice), &library) == 0) return false;
  using namespace boost::interprocess;
  const mapped_region file(file_mapping(library.dli_fname, read_only), read_only);
  const std::string_view content(static_cast<const char*>(file.get_address()), file.get_size());
  // Put together here, so as not to be found in this program where Embree is part of it.
  return content.find(fmt::format("{}()", "ray.valid")) != std::string_view::npos;
}

EmbreeGeometry::EmbreeGeometry(RTCGeometryType type) : geometry_(rtcNewGeometry(embree_device(), type)) {
  check();
}

void* EmbreeGeometry::buffer(RTCBufferType type, RTCFormat format, std::size_t element_bytes,
                             std::size_t count) {
  void* const data = rtcSetNewGeometryBuffer(geometry_, type, 0, format, element_bytes, count);
  check();
  return data;
}

EmbreeScene::EmbreeScene(RTCBuildQuality quality, bool robust)
    : scene_(rtcNewScene(embree_device())), quality_(quality) {
  check();
  rtcSetSceneBuildQuality(scene_, quality);
  rtcSetSceneFlags(scene_, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
}

void EmbreeScene::attach(const EmbreeGeometry& geometry, unsigned number) {
  rtcSetGeometryBuildQuality(geometry.get(), quality_);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene_, geometry.get(), number);
  check();
}

void EmbreeScene::build() {
  const std::int64_t before = live_bytes;
  rtcCommitScene(scene_);
  check();
  bytes_ = static_cast<std::uint64_t>(std::max<std::int64_t>(0, live_bytes - before));
}

}  // namespace rayshoot
