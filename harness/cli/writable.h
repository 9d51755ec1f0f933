#pragma once

#include "scenes/io/output_file.h"

namespace rayshoot::cli {

/// Throws InputError unless a file can be written there: better found out before the work than after it.
inline void require_writable(const std::string& path) { OutputFile probe(path); }

}  // namespace rayshoot::cli
