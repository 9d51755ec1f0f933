#include "accel/core/registry.h"

namespace rayshoot {

CountedWork& CountedWork::operator+=(const CountedWork& other) {
  total += other.total;
  distinct_squares += other.distinct_squares, distinct_differences += other.distinct_differences;
  object_test_squares += other.object_test_squares;
  cell_squares += other.cell_squares;
  volume_test_squares += other.volume_test_squares;
  return *this;
}

const TechniqueEntry& technique_entry(const std::string& id) {
  std::vector<std::string> known;
  for (const TechniqueEntry* entry : technique_entries()) {
    if (entry->info.id == id) return *entry;
    known.push_back(entry->info.id);
  }
  throw InputError(unknown_name("technique", id, known));
}

}  // namespace rayshoot
