#pragma once

#include <map>
#include <regex>
#include <string>
#include <vector>

namespace rayshoot::analysis {

/// A table as it stands on a page: titles of its columns with their units, "time ns/ray", and the texts of its rows.
struct PageTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// The words of a piece of a page, without its markup.
inline std::string words_of(std::string html) {
  html = std::regex_replace(html, std::regex("<span>"), " ");
  html = std::regex_replace(html, std::regex("<[^>]*>"), "");
  for (const auto& [name, character] : std::map<std::string, std::string>{
           {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&nbsp;", ""}, {"&amp;", "&"}})
    for (std::size_t at = 0; (at = html.find(name, at)) != std::string::npos; at += character.size())
      html.replace(at, name.size(), character);
  while (html.ends_with(' ')) html.pop_back();
  return html;
}

/// What stands between two marks, and from where on to look further; nothing when there is no more.
inline bool take_between(const std::string& html, const std::string& begin, const std::string& end,
                         std::size_t& at, std::string& taken) {
  const std::size_t from = html.find(begin, at);
  if (from == std::string::npos) return false;
  const std::size_t open = html.find('>', from) + 1, to = html.find(end, open);
  if (to == std::string::npos) return false;
  taken = html.substr(open, to - open);
  at = to + end.size();
  return true;
}

inline std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::size_t at = 0;
  for (std::size_t next; (next = row.find("<t", at)) != std::string::npos;) {
    const std::string end = row.compare(next, 3, "<th") == 0 ? "</th>" : "</td>";
    std::string cell;
    if (!take_between(row, row.substr(next, 3), end, at, cell)) break;
    cells.push_back(words_of(cell));
  }
  return cells;
}

/// All tables of a page.
inline std::vector<PageTable> page_tables(const std::string& page) {
  std::vector<PageTable> tables;
  std::string html;
  for (std::size_t at = 0; take_between(page, "<table ", "</table>", at, html);) {
    const std::size_t begin = page.rfind("<table ", at), name = page.find("aria-label=\"", begin) + 12;
    PageTable table{.title = words_of(page.substr(name, page.find('"', name) - name))};
    std::size_t in_table = 0;
    std::string row;
    while (take_between(html, "<tr", "</tr>", in_table, row))
      if (table.columns.empty())
        table.columns = cells_of(row);
      else
        table.rows.push_back(cells_of(row));
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace rayshoot::analysis
