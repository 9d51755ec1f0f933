#pragma once

#include <embree3/rtcore.h>

#include <cstdint>

namespace rayshoot {

/// Coordinates beyond this are refused by Embree: it ignores objects and aborts on rays that have them.
inline constexpr float kEmbreeLargest = 1.8e18f;

/// The one Embree device of this process. Throws std::runtime_error where Embree does not run.
RTCDevice embree_device();

/// An Embree geometry while it is being filled; `EmbreeScene::attach` takes it.
class EmbreeGeometry {
 public:
  explicit EmbreeGeometry(RTCGeometryType type);
  ~EmbreeGeometry() { rtcReleaseGeometry(geometry_); }
  EmbreeGeometry(const EmbreeGeometry&) = delete;
  EmbreeGeometry& operator=(const EmbreeGeometry&) = delete;

  RTCGeometry get() const { return geometry_; }
  /// A new buffer of `count` elements for the caller to fill; throws std::bad_alloc.
  template <class Element>
  Element* buffer(RTCBufferType type, RTCFormat format, std::size_t count) {
    return static_cast<Element*>(buffer(type, format, sizeof(Element), count));
  }

 private:
  void* buffer(RTCBufferType type, RTCFormat format, std::size_t element_bytes, std::size_t count);

  RTCGeometry geometry_;
};

/// An Embree scene: geometries are attached, then the tree is built, then threads may share it.
class EmbreeScene {
 public:
  EmbreeScene(RTCBuildQuality quality, bool robust);
  ~EmbreeScene() { rtcReleaseScene(scene_); }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Add a filled geometry under a number of its own.
  void attach(const EmbreeGeometry& geometry, unsigned number);
  /// Build the tree. Throws std::bad_alloc or std::runtime_error when Embree fails.
  void build();

  RTCScene get() const { return scene_; }
  /// Memory the tree holds, as Embree reports it; exact where no other scene is built or released meanwhile.
  std::uint64_t bytes() const { return bytes_; }

 private:
  RTCScene scene_;
  RTCBuildQuality quality_;
  std::uint64_t bytes_ = 0;
};

}  // namespace rayshoot
