#include "report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "report/base64.h"

namespace knotlight {
namespace {

constexpr const char* style = R"(
:root { color-scheme: light; }
body { margin: 0 auto; max-width: 68rem; padding: 2rem 1.2rem 4rem; background: #fff;
  color: #222; font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .3rem; }
h2 { font-size: 1.35rem; margin: 2.6rem 0 .6rem; padding-top: .8rem; border-top: 1px solid #ddd; }
h3 { font-size: 1.08rem; margin: 1.6rem 0 .4rem; }
p { max-width: 46rem; margin: .5rem 0; }
.summary { color: #555; font-size: 1.08rem; }
.callout { max-width: none; margin: 1.2rem 0; padding: .8rem 1.1rem; background: #fff8e6;
  border-left: 5px solid #e69f00; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; margin: .8rem 0; font-size: .93rem; }
th, td { padding: .32rem .7rem; border-bottom: 1px solid #e4e4e4; text-align: left;
  vertical-align: top; }
th { border-bottom: 2px solid #999; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
tr.pass td:first-child { border-left: 4px solid #009e73; }
tr.fail td { background: #fdece4; }
tr.fail td:first-child { border-left: 4px solid #d55e00; }
figure { margin: .8rem 0; }
figure svg, figure img { display: block; max-width: 100%; height: auto; }
figure svg { width: 100%; max-width: 50rem; }
figure img { border: 1px solid #ddd; }
figcaption { margin-top: .35rem; font-size: .88rem; line-height: 1.4; color: #555; }
.row { display: flex; flex-wrap: wrap; gap: 1rem 1.2rem; align-items: flex-start; }
.row figure { flex: 0 1 15.9rem; margin: .4rem 0; }
.row figure img { width: 100%; }
@media print {
  body { max-width: none; padding: 0; font-size: 10.5pt; }
  h2, h3 { break-after: avoid; } figure, tr { break-inside: avoid; }
  .scroll { overflow: visible; }
}
)";

// A cell that starts like a number, or says that there is none, belongs in a column of numbers.
bool reads_as_number(const std::string& cell) {
  const auto first = cell.find_first_not_of(" +-<>");
  return first == std::string::npos ? !cell.empty()
                                    : std::isdigit(static_cast<unsigned char>(cell[first])) != 0 ||
                                          cell == "nan" || cell == "inf" || cell == "unknown";
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

std::string figure(const std::string& content_html, const std::string& caption) {
  const std::string below =
      caption.empty() ? "" : fmt::format("<figcaption>{}</figcaption>", html_escape(caption));
  return fmt::format("<figure>{}{}</figure>\n", content_html, below);
}

}  // namespace

std::string html_escape(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string html_page(const std::string& title, const std::string& summary,
                      const std::string& body_html) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n{2}{3}"
      "</body>\n</html>\n",
      html_escape(title), style,
      summary.empty() ? "" : fmt::format("<p class=\"summary\">{}</p>\n", html_escape(summary)),
      body_html);
}

std::string html_heading(int level, const std::string& text) {
  return fmt::format("<h{0}>{1}</h{0}>\n", level, html_escape(text));
}

std::string html_paragraph(const std::string& text) {
  return fmt::format("<p>{}</p>\n", html_escape(text));
}

std::string html_callout(const std::string& text) {
  return fmt::format("<p class=\"callout\">{}</p>\n", html_escape(text));
}

std::string html_list(const std::vector<std::string>& items) {
  std::string html = "<ul>\n";
  for (const std::string& item : items) html += fmt::format("<li>{}</li>\n", html_escape(item));
  return html + "</ul>\n";
}

std::string html_table(const std::vector<std::string>& header,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::string>& row_classes) {
  std::string html = "<div class=\"scroll\"><table>\n<thead><tr>";
  for (const std::string& cell : header) html += "<th>" + html_escape(cell) + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool marked = i < row_classes.size() && !row_classes[i].empty();
    html += marked ? fmt::format("<tr class=\"{}\">", html_escape(row_classes[i])) : "<tr>";
    for (const std::string& cell : rows[i])
      html += fmt::format("<td{}>{}</td>", reads_as_number(cell) ? " class=\"number\"" : "",
                          html_escape(cell));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string html_figure_svg(const std::string& svg, const std::string& name,
                            const std::string& caption) {
  std::string own = svg;
  for (const char* quote : {"'", "\""}) {
    replace_all(own, fmt::format(" id={}", quote), fmt::format(" id={}{}-", quote, name));
    replace_all(own, fmt::format("href={}#", quote), fmt::format("href={}#{}-", quote, name));
  }
  replace_all(own, "url(#", fmt::format("url(#{}-", name));
  return figure(own, caption);
}

std::string html_figure_png(const std::vector<unsigned char>& png, const std::string& alternative,
                            const std::string& caption) {
  return figure(fmt::format("<img src=\"data:image/png;base64,{}\" alt=\"{}\">", base64(png),
                            html_escape(alternative)),
                caption);
}

std::string html_row(const std::vector<std::string>& figures_html) {
  std::string html = "<div class=\"row\">\n";
  for (const std::string& figure_html : figures_html) html += figure_html;
  return html + "</div>\n";
}

}  // namespace knotlight
