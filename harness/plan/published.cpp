#include "harness/plan/published.h"

#include "harness/plan/builtin.h"
#include "harness/plan/suite_json.h"

namespace rayshoot {

namespace {

auto figures(std::map<std::string, double>& target) {
  return [&target](const Json& json, const Place& place) {
    Readers readers;
    for (const std::string& name : figure_names())
      readers[name] = [&target, &name](const Json& value, const Place& where) {
        number(target[name], 0, 1e18)(value, where);
      };
    read_object(json, place, readers);
  };
}

auto rows(std::vector<PublishedRow>& target) {
  return [&target](const Json& json, const Place& place) {
    for_each(json, place, [&](const Json& entry, const Place& where) {
      PublishedRow& row = target.emplace_back();
      read_object(entry, where,
                  {{"scene", text(row.scene)},
                   {"technique", text(row.technique)},
                   {"label", text(row.label)},
                   {"figures", figures(row.figures)}});
    });
  };
}

auto claims(std::vector<PublishedClaim>& target) {
  return [&target](const Json& json, const Place& place) {
    for_each(json, place, [&](const Json& entry, const Place& where) {
      PublishedClaim& claim = target.emplace_back();
      read_object(entry, where,
                  {{"scene", text(claim.scene)},
                   {"first", text(claim.first)},
                   {"second", text(claim.second)},
                   {"relation", text(claim.relation)}});
      require_known("relation", {claim.relation}, {"faster", "similar"});
    });
  };
}

}  // namespace

const std::vector<std::string>& figure_names() {
  static const std::vector<std::string> names{"interior_nodes",
                                              "leaves",
                                              "empty_leaves",
                                              "references",
                                              "object_tests_per_ray",
                                              "steps_per_ray",
                                              "cells_per_ray",
                                              "empty_cells_per_ray",
                                              "volume_tests_per_ray",
                                              "object_tests_per_hit",
                                              "object_tests",
                                              "volume_tests",
                                              "orphans",
                                              "hierarchy_nodes"};
  return names;
}

Published parse_published(const std::string& text_of_file, const std::string& name) {
  const Place place{"published " + name};
  Published published;
  read_object(parse_json(text_of_file, place), place,
              {{"source", text(published.source)},
               {"rows", rows(published.rows)},
               {"claims", claims(published.claims)}});
  return published;
}

Published load_published(const std::string& name) {
  const auto found = builtin_published_texts().find(name);
  if (found != builtin_published_texts().end()) return parse_published(found->second, name);
  std::vector<std::string> known;
  for (const auto& entry : builtin_published_texts()) known.push_back(entry.first);
  throw InputError(unknown_name("published figures", name, known));
}

}  // namespace rayshoot
