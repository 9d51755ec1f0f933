#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "analysis/statistics/power_law.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/families.h"

namespace rayshoot::analysis {

namespace {

using report::Status;
using report::Work;

/// What grows with the number of objects.
struct Growing {
  const char *key, *title, *meaning;
  std::optional<double> (*value)(const Entry&);
};

std::optional<double> time(const Entry& entry) {
  const auto ns = time_per_ray(entry);
  return ns ? std::optional(ns->value) : std::nullopt;
}

std::optional<double> tests(const Entry& entry) {
  return per_ray(entry.measurement->work, &Work::object_tests);
}

std::optional<double> build(const Entry& entry) {
  const auto ns = median(entry.measurement->build_ns);
  return ns ? std::optional(ns->value) : std::nullopt;
}

std::optional<double> bytes(const Entry& entry) {
  const auto& structure = entry.measurement->structure;
  return structure ? std::optional(static_cast<double>(structure->bytes)) : std::nullopt;
}

constexpr std::array kGrowing = {
    Growing{"time_exponent", "time ^",
            "p where the time a ray grows as objects^p, fitted to the logarithms, and Student's 95 % "
            "interval of it",
            time},
    Growing{"tests_exponent", "tests ^", "the same of ray-object tests a ray", tests},
    Growing{"build_exponent", "build ^", "the same of the time of the build", build},
    Growing{"memory_exponent", "memory ^", "the same of what was built", bytes}};

/// A technique in the sizes in which it was right, from the smallest.
struct Curve {
  std::vector<double> objects;
  std::vector<const Entry*> entries;

  /// Nothing where it is missing, or zero, in fewer sizes than a fit needs.
  std::optional<PowerLaw> law(const Growing& growing) const {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < entries.size(); ++i)
      if (const auto value = growing.value(*entries[i]); value && *value > 0)
        x.push_back(objects[i]), y.push_back(*value);
    return x.size() < kLeastSizes ? std::nullopt : fit_power_law(x, y);
  }
};

using NamedCurve = std::pair<std::string, Curve>;

/// Techniques of enough sizes, those whose time grows the least first.
std::vector<NamedCurve> curves(const Family& family) {
  std::map<std::string, Curve> by_label;
  for (const auto& [objects, group] : family.by_objects)
    for (const Entry& entry : group->entries) {
      const Status status = entry.measurement->verdict.status;
      if (status != Status::ok && status != Status::graded) continue;
      by_label[entry.label].objects.push_back(static_cast<double>(objects));
      by_label[entry.label].entries.push_back(&entry);
    }
  std::erase_if(by_label, [](const auto& curve) { return curve.second.entries.size() < kLeastSizes; });
  std::vector<NamedCurve> result(by_label.begin(), by_label.end());
  const auto exponent = [](const NamedCurve& curve) {
    const auto law = curve.second.law(kGrowing[0]);
    return law ? law->exponent.value : std::numeric_limits<double>::infinity();
  };
  std::stable_sort(result.begin(), result.end(),
                   [&](const NamedCurve& a, const NamedCurve& b) { return exponent(a) < exponent(b); });
  return result;
}

/// A page says in its title what CSV says in every row.
std::vector<Column> columns() {
  std::vector<Column> result{
      {.key = "technique", .title = "technique", .style = Style::text},
      {.key = "scene", .style = Style::text, .place = Place::csv},
      {.key = "rays", .style = Style::text, .place = Place::csv},
      {.key = "precision", .style = Style::text, .place = Place::csv},
      {"sizes", "sizes", "", "sizes of the scene in which the technique is right", Style::whole},
      {"objects_to", "up to", "objects", "", Style::whole}};
  for (const Growing& growing : kGrowing) {
    result.push_back({.key = std::string(growing.key) + "_text",
                      .title = growing.title,
                      .meaning = growing.meaning,
                      .style = Style::text,
                      .place = Place::page});
    for (const char* part : {"", "_low", "_high"})
      result.push_back({.key = std::string(growing.key) + part, .place = Place::csv});
  }
  result.push_back({"bytes_per_object", "memory", "B/object", "what was built, in the largest size"});
  Column last = time_column();
  last.meaning = "in the largest size";
  result.push_back(last);
  return result;
}

/// An exponent for readers, and then its parts.
void append_law(std::vector<Cell>& row, const std::optional<PowerLaw>& law) {
  if (!law) return row.resize(row.size() + 4);
  const auto& [value, interval] = law->exponent;
  row.push_back(
      {std::nullopt, interval ? fmt::format("{:.2f} [{:.2f}, {:.2f}]", value, interval->low, interval->high)
                              : fmt::format("{:.2f}", value)});
  row.push_back({value, ""});
  row.push_back({interval ? std::optional(interval->low) : std::nullopt, ""});
  row.push_back({interval ? std::optional(interval->high) : std::nullopt, ""});
}

std::vector<Cell> row_of(const Family& family, const std::string& label, const Curve& curve) {
  const double largest = curve.objects.back();
  const Entry& last = *curve.entries.back();
  std::vector<Cell> row;
  for (const std::string& name : {label, family.scene, family.rays, family.precision})
    row.push_back({std::nullopt, name});
  row.push_back({static_cast<double>(curve.objects.size()), ""});
  row.push_back({largest, ""});
  for (const Growing& growing : kGrowing) append_law(row, curve.law(growing));
  const auto held = bytes(last);
  row.push_back({held ? std::optional(*held / largest) : std::nullopt, ""});
  row.push_back({time(last), ""});
  return row;
}

Table growth_table(const Family& family, const std::string& run) {
  Table table{.title = fmt::format("{}{}, {}, {}: growth from {} to {} objects", run, family.scene,
                                   family.rays, family.precision, family.by_objects.begin()->first,
                                   family.by_objects.rbegin()->first),
              .columns = columns()};
  for (const auto& [label, curve] : curves(family)) table.rows.push_back(row_of(family, label, curve));
  return table;
}

}  // namespace

std::vector<Table> growth_tables(const std::vector<report::Report>& reports) {
  std::vector<Table> tables;
  for (const report::Report& report : reports) {
    const std::string run = reports.size() > 1 ? fmt::format("[{}] ", report.run.id) : "";
    const std::vector<Group> measured = groups(report);
    for (const Family& family : families(measured))
      if (Table table = growth_table(family, run); !table.rows.empty()) tables.push_back(std::move(table));
  }
  return tables;
}

std::string render_growth(const std::vector<report::Report>& reports, Format format) {
  const std::vector<Table> tables = growth_tables(reports);
  return tables.empty() ? "" : render(tables, format);
}

}  // namespace rayshoot::analysis
