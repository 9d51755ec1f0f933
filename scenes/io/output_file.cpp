#include "scenes/io/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "scenes/core/spec.h"

namespace rayshoot {

OutputFile::OutputFile(const std::string& path)
    : target_(path), temporary_(fmt::format("{}.{}.part", path, ::getpid())) {
  std::error_code ignored;
  if (std::filesystem::exists(target_, ignored) && !std::filesystem::is_regular_file(target_, ignored))
    fail("it is not a regular file");
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) fail(std::strerror(errno));
}

OutputFile::~OutputFile() {
  stream_.close();
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void OutputFile::commit() {
  errno = 0;
  stream_.close();
  if (!stream_) fail(errno ? std::strerror(errno) : "writing failed");
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) fail(error.message());
  temporary_.clear();
}

void OutputFile::fail(const std::string& reason) const {
  throw InputError(fmt::format("cannot write {}: {}", target_.string(), reason));
}

}  // namespace rayshoot
