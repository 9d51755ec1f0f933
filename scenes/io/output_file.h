#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace rayshoot {

/// A file that appears under its name only when it is complete: it is written beside the target and renamed
/// at the end; abandoned, it leaves nothing behind. Every failure is an InputError that names the target.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ostream& stream() { return stream_; }
  /// Put the finished file in the place of the target.
  void commit();

 private:
  [[noreturn]] void fail(const std::string& reason) const;

  std::filesystem::path target_, temporary_;
  std::ofstream stream_;
};

}  // namespace rayshoot
