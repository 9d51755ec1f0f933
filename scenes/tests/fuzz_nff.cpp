// Fuzz target: any bytes are either refused in one line or a scene that, written in full, reads back the same.
#include <cstdlib>
#include <sstream>

#include "scenes/core/spec.h"
#include "scenes/io/nff.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rayshoot;
  Scene scene;
  try {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    scene = read_nff(in, "fuzz.nff");
  } catch (const InputError& refused) {
    if (std::string(refused.what()).find('\n') != std::string::npos) std::abort();
    return 0;
  }
  std::stringstream written;
  write_nff(scene, written, kFullPrecision);
  if (!same_content(read_nff(written, "written.nff"), scene)) std::abort();
  return 0;
}
