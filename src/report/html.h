// Pages that stand alone: one HTML file with its style, charts and pictures inside it, readable on
// a screen and on paper, with nothing fetched from elsewhere.
#pragma once

#include <string>
#include <vector>

namespace knotlight {

// Text as it must stand in HTML: & < > and quotes escaped.
std::string html_escape(const std::string& text);

// In all that follows, `..._html` is markup that is taken as it is; everything else is plain text.

// A whole page. summary: a sentence under the title, empty for none.
std::string html_page(const std::string& title, const std::string& summary,
                      const std::string& body_html);

std::string html_heading(int level, const std::string& text);  // level 2 or 3
std::string html_paragraph(const std::string& text);
std::string html_list(const std::vector<std::string>& items);
// The sentence a reader should take home, set apart.
std::string html_callout(const std::string& text);

// Cells are plain text; those that read as a number (with or without a unit or %) stand to the
// right. `row_classes` marks rows, one word each: "pass", "fail" or "" (may be empty).
std::string html_table(const std::vector<std::string>& header,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::string>& row_classes = {});

// A chart from an SVG element; an empty caption is left out. Names inside the SVG are made unique
// to the `name`, a word that no other figure of the page has, so that charts on one page do not
// draw with each other's parts.
std::string html_figure_svg(const std::string& svg, const std::string& name,
                            const std::string& caption);

// A picture from the bytes of a PNG file, embedded as a data URI. alternative: what it shows, for
// those who cannot see it.
std::string html_figure_png(const std::vector<unsigned char>& png, const std::string& alternative,
                            const std::string& caption);

// Figures side by side, as many as fit the width.
std::string html_row(const std::vector<std::string>& figures_html);

}  // namespace knotlight
