#pragma once

#include <string>
#include <vector>

#include "analysis/plots/plots.h"
#include "analysis/tables/table.h"

/// Parts of a page. All text that comes from reports is escaped.
namespace rayshoot::analysis {

/// A table with its title and notes; columns without a value are left out, as in all renderings for readers.
std::string html_table(const Table& table);

/// A plot with its caption.
std::string html_figure(const Plot& plot);

/// A picture in the format PNG, as part of the page, under its name.
std::string html_picture(const std::string& name, const std::string& png);

/// What the columns of tables mean.
std::string html_legend(const std::vector<Table>& tables);

/// A paragraph each.
std::string html_paragraphs(const std::vector<std::string>& texts);

struct Section {
  std::string id, title, body;
};

/// A whole document, which needs no other file: light or dark as the reader prefers, plain on paper. Its script sorts
/// tables and nothing else.
std::string html_page(const std::string& title, const std::string& subtitle,
                      const std::vector<Section>& sections);

}  // namespace rayshoot::analysis
