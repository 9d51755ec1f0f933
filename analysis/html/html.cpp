#include "analysis/html/html.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/plots/svg.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

constexpr const char* kStyle = R"(
:root{color-scheme:light dark;--ink:#1b1f24;--faint:#5b6470;--ground:#fff;--panel:#f5f6f8;--rule:#d9dde2;--link:#005a9c;--bad:#a33b00}
@media (prefers-color-scheme:dark){:root{--ink:#e6e8eb;--faint:#9aa3af;--ground:#14171b;--panel:#1d2126;--rule:#343a42;--link:#7cc0f2;--bad:#ff9b66}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:78rem;padding:1rem;font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--ground)}
h1{font-size:1.7rem;margin:.5rem 0 0}h2{font-size:1.25rem;margin:2.2rem 0 .6rem;border-bottom:1px solid var(--rule)}
a{color:var(--link)}p{max-width:46rem;margin:.4rem 0}.subtitle{color:var(--faint);margin-top:.1rem;overflow-wrap:anywhere}
nav{display:flex;flex-wrap:wrap;gap:.2rem 1rem;margin:.8rem 0}
.scroll{overflow-x:auto;margin:0 0 .3rem}
table{border-collapse:collapse;font-size:.84rem;font-variant-numeric:tabular-nums;line-height:1.35}
h3{font-size:.95rem;margin:1.2rem 0 .2rem;overflow-wrap:anywhere}
th,td{padding:.16rem .55rem;text-align:right;white-space:nowrap}
thead th{border-bottom:2px solid var(--rule);vertical-align:bottom;font-weight:600}
thead span{display:block;font-weight:400;color:var(--faint);font-size:.92em;min-height:1em}
tbody tr:nth-child(odd){background:var(--panel)}
th:first-child{text-align:left;font-weight:500;position:sticky;left:0;background:inherit;max-width:20rem;white-space:normal;overflow-wrap:break-word}
thead tr,tbody tr:nth-child(even){background:var(--ground)}
th.words{text-align:left}td.words{text-align:left;white-space:normal;overflow-wrap:anywhere;min-width:7rem}td.bad{color:var(--bad);font-weight:700}
.sortable thead th{cursor:pointer}.sortable th[aria-sort=ascending]::after{content:" ▲"}.sortable th[aria-sort=descending]::after{content:" ▼"}
ul.notes{font-size:.84rem;color:var(--faint);margin:.2rem 0 1rem;padding-left:1.2rem;max-width:60rem;overflow-wrap:anywhere}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,30rem),1fr));gap:1.2rem}
figure{margin:0;break-inside:avoid}figure h3{margin:.2rem 0}figcaption{font-size:.84rem;color:var(--faint)}
img.picture{display:block;max-width:100%;height:auto}
svg.plot{display:block;width:100%;height:auto;max-width:44rem}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.15rem 1rem;font-size:.88rem}dt{font-weight:600}dd{margin:0;grid-column:2}
@media (max-width:34rem){body{padding:.6rem}th:first-child{max-width:8.5rem}th,td{padding:.16rem .35rem}dl{grid-template-columns:1fr}dd{grid-column:1;margin:0 0 .4rem 1rem}}
@media print{:root{color-scheme:light;--ink:#000;--faint:#333;--ground:#fff;--panel:#f2f2f2;--rule:#aaa;--link:#000;--bad:#000}
body{max-width:none;padding:0;font-size:10pt}nav{display:none}.scroll{overflow:visible}table{font-size:6.5pt}th,td{padding:.08rem .25rem}
ul.notes,figcaption,dl{font-size:7pt}tr{break-inside:avoid}h2,h3{break-after:avoid}.figures{grid-template-columns:1fr 1fr}th:first-child{position:static}}
)";

constexpr const char* kScript = R"(
for(const table of document.querySelectorAll("table.sortable"))table.querySelectorAll("thead th").forEach((head,column)=>{
head.tabIndex=0;
const sort=()=>{
const up=head.getAttribute("aria-sort")==="descending"||(!head.hasAttribute("aria-sort")&&column===0);
table.querySelectorAll("thead th").forEach(other=>other.removeAttribute("aria-sort"));
head.setAttribute("aria-sort",up?"ascending":"descending");
const key=row=>row.cells[column].textContent,number=row=>{const n=parseFloat(key(row));return isNaN(n)?null:n};
const order=(a,b)=>{const x=number(a),y=number(b);
if(column>0&&(x===null||y===null))return (x===null)-(y===null);
return (up?1:-1)*(column>0?x-y:key(a).localeCompare(key(b)))};
const body=table.tBodies[0];[...body.rows].sort(order).forEach(row=>body.append(row))};
head.addEventListener("click",sort);
head.addEventListener("keydown",event=>{if(event.key==="Enter"||event.key===" "){event.preventDefault();sort()}})});
)";

/// A list of notes; nothing without any.
std::string notes_list(const std::vector<std::string>& notes) {
  if (notes.empty()) return "";
  std::string result = "<ul class=\"notes\">\n";
  for (const std::string& note : notes) result += fmt::format("<li>{}</li>\n", xml_escaped(note));
  return result + "</ul>\n";
}

std::string head_of(const Page& page) {
  std::string result = "<thead><tr>";
  for (const Column& column : page.columns)
    result += fmt::format(
        "<th scope=\"col\"{}{}>{}<span>{}</span></th>", column.style == Style::text ? " class=\"words\"" : "",
        column.meaning.empty() ? "" : fmt::format(" title=\"{}\"", xml_escaped(column.meaning)),
        xml_escaped(column.title), column.unit.empty() ? "&nbsp;" : xml_escaped(column.unit));
  return result + "</tr></thead>\n";
}

/// The name of a row, which may be broken after punctuation.
std::string breakable(const std::string& name) {
  std::string result;
  for (const char c : name) {
    result += xml_escaped(std::string(1, c));
    if (std::string_view("_(,/|").find(c) != std::string_view::npos) result += "<wbr>";
  }
  return result;
}

std::string row_of(const Page& page, const std::vector<std::string>& cells) {
  std::string result = fmt::format("<tr><th scope=\"row\">{}</th>", breakable(cells[0]));
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const bool bad = cells[i] == "WRONG" || cells[i] == "FAILED";
    const char* style = bad                                    ? " class=\"bad\""
                        : page.columns[i].style == Style::text ? " class=\"words\""
                                                               : "";
    result += fmt::format("<td{}>{}</td>", style, xml_escaped(cells[i]));
  }
  return result + "</tr>\n";
}

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0);
    for (std::size_t j = 0; j < 4; ++j) text += j <= count ? digits[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

}  // namespace

std::string html_table(const Table& table) {
  const Page page = page_of(table);
  if (table.rows.empty() || page.columns.empty())
    return fmt::format("<p><strong>{}</strong></p>\n{}", xml_escaped(table.title), notes_list(table.notes));
  std::string result = fmt::format(
      "<h3>{0}</h3>\n<div class=\"scroll\"><table class=\"sortable\" aria-label=\"{0}\">\n{1}<tbody>\n",
      xml_escaped(table.title), head_of(page));
  for (const auto& row : page.rows) result += row_of(page, row);
  return result + "</tbody></table></div>\n" + notes_list(table.notes);
}

std::string html_figure(const Plot& plot) {
  return fmt::format("<figure>\n<h3>{}</h3>\n{}<figcaption>{}</figcaption>\n</figure>\n",
                     xml_escaped(plot.title), plot.svg, xml_escaped(plot.caption));
}

std::string html_picture(const std::string& name, const std::string& png) {
  return fmt::format(
      "<figure>\n<h3>{0}</h3>\n<img class=\"picture\" alt=\"{0}\" src=\"data:image/png;base64,{1}\">\n"
      "<figcaption>Drawn by rayshoot render, not out of the report.</figcaption>\n</figure>\n",
      xml_escaped(name), base64(png));
}

std::string html_legend(const std::vector<Table>& tables) {
  // A title may mean one thing here and another there.
  std::vector<std::pair<std::string, std::string>> lines;
  for (const auto& [title, meaning] : legend(tables)) {
    const auto same = [&name = title](const auto& line) { return line.first == name; };
    auto line = std::find_if(lines.begin(), lines.end(), same);
    if (line == lines.end()) line = lines.insert(lines.end(), {title, ""});
    line->second += fmt::format("<dd>{}</dd>\n", xml_escaped(meaning));
  }
  std::string result = "<dl>\n";
  for (const auto& [title, meanings] : lines)
    result += fmt::format("<dt>{}</dt>{}", xml_escaped(title), meanings);
  return result + "</dl>\n";
}

std::string html_paragraphs(const std::vector<std::string>& texts) {
  std::string result;
  for (const std::string& text : texts) result += fmt::format("<p>{}</p>\n", xml_escaped(text));
  return result;
}

std::string html_page(const std::string& title, const std::string& subtitle,
                      const std::vector<Section>& sections) {
  std::string navigation, body;
  for (const Section& section : sections) {
    navigation += fmt::format("<a href=\"#{}\">{}</a>\n", section.id, xml_escaped(section.title));
    body += fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", section.id,
                        xml_escaped(section.title), section.body);
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
      "<style>{1}{2}</style>\n</head>\n<body>\n<header>\n<h1>{0}</h1>\n<p class=\"subtitle\">{3}</p>\n"
      "<nav "
      "aria-label=\"Contents\">\n{4}</nav>\n</header>\n<main>\n{5}</main>\n<script>{6}</script>\n</body>\n</"
      "html>\n",
      xml_escaped(title), kStyle, plot_style(), xml_escaped(subtitle), navigation, body, kScript);
}

}  // namespace rayshoot::analysis
