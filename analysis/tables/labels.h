#pragma once

#include <map>
#include <set>
#include <string>

#include "harness/report/report.h"

namespace rayshoot::analysis {

using Config = std::map<std::string, report::ConfigValue>;

/// All of a configuration: "density=0.5;mailbox=on".
std::string config_text(const Config& config);

/// Names techniques: by id, with those keys of the configuration that differ among all that were added.
class Labels {
 public:
  void add(const std::string& technique, const Config& config);
  /// The label of something that was added.
  std::string operator()(const std::string& technique, const Config& config) const;

 private:
  struct Uses {
    std::size_t count = 0;
    /// For every key, the values that it had and how often it was there.
    std::map<std::string, std::set<std::string>> values;
    std::map<std::string, std::size_t> present;
    bool differs(const std::string& key) const;
  };
  std::map<std::string, Uses> uses_;
};

}  // namespace rayshoot::analysis
