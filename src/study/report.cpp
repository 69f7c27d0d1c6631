#include "study/report.h"

#include <fmt/format.h>

#include <cassert>
#include <cctype>
#include <cmath>
#include <utility>

#include "core/file_io.h"
#include "report/csv.h"
#include "report/html.h"

namespace knotlight {
namespace {

namespace fs = std::filesystem;

std::string words_of(const Study& study) {
  return fmt::format("{}: {} ({})", study.name, study.title, study.place);
}

std::string capitalised(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::vector<std::string> texts(const std::vector<Cell>& row) {
  std::vector<std::string> cells;
  for (const Cell& cell : row) cells.push_back(cell_text(cell));
  return cells;
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) {
    line += ' ';
    for (const char c : cell) line += c == '|' ? std::string("\\|") : std::string(1, c);
    line += " |";
  }
  return line + "\n";
}

std::string markdown_table(const StudyTable& table) {
  std::string text = fmt::format("*{}*\n\n", table.title) + markdown_row(table.columns) +
                     markdown_row(std::vector<std::string>(table.columns.size(), "---"));
  for (const std::vector<Cell>& row : table.rows) text += markdown_row(texts(row));
  return text + "\n";
}

std::string contents(const std::vector<StudyResult>& results) {
  std::string text =
      markdown_row({"study", "in the thesis", "question"}) + markdown_row({"---", "---", "---"});
  for (const StudyResult& result : results)
    text += markdown_row(
        {fmt::format("[{0}](#{0})", result.study.name), result.study.place, result.study.title});
  return text + "\n";
}

std::string svg_file(const std::string& element) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + element;
}

constexpr const char* introduction =
    "Every table and figure of results of the thesis (W. Vanmontfort, Universiteit Hasselt, "
    "2009, [V09]) done again: what it says, the same after its method, the same as it should "
    "be, and why. Errors are measured at points that are not knots; seconds are processor time "
    "on the machine that made this page, by `knotlight study NAME -o DIR`.";

}  // namespace

std::string cell_text(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const double number = std::get<double>(cell);
  return std::isnan(number) ? "-" : fmt::format("{:.4g}", number);
}

std::string table_csv(const StudyTable& table) {
  std::vector<std::vector<std::string>> rows;
  for (const std::vector<Cell>& row : table.rows) {
    assert(row.size() == table.columns.size());
    std::vector<std::string> fields;
    for (const Cell& cell : row) {
      const auto* text = std::get_if<std::string>(&cell);
      fields.push_back(text != nullptr ? *text : csv_number(std::get<double>(cell)));
    }
    rows.push_back(std::move(fields));
  }
  return csv_text(table.columns, rows);
}

std::string file_stem(const Study& study, const std::string& part) {
  return part.empty() ? study.name : study.name + "-" + part;
}

std::string studies_markdown(const std::vector<StudyResult>& results, const std::string& links) {
  std::string text =
      fmt::format("# The experiments of the thesis, done again\n\n{}\n\n", introduction);
  if (results.size() > 1) text += contents(results);
  for (const auto& [study, findings] : results) {
    text += fmt::format("## {}\n\n{} ({}).\n\n**The thesis.** {}\n\n", study.name,
                        capitalised(study.title), study.place, study.thesis);
    for (const StudyTable& table : findings.tables) text += markdown_table(table);
    for (const StudyChart& chart : findings.charts)
      text += fmt::format("![{}]({}{}.svg)\n\n{}\n\n", chart.chart.title, links,
                          file_stem(study, chart.name), chart.caption);
    text += fmt::format("**Why.** {}\n\n", findings.why);
  }
  text.pop_back();  // one line's end at the end
  return text;
}

std::string studies_html(const std::vector<StudyResult>& results) {
  std::string body;
  for (const auto& [study, findings] : results) {
    body += html_heading(2, words_of(study)) + html_paragraph("The thesis. " + study.thesis);
    for (const StudyTable& table : findings.tables) {
      body += html_paragraph(table.title);
      std::vector<std::vector<std::string>> rows;
      for (const std::vector<Cell>& row : table.rows) rows.push_back(texts(row));
      body += html_table(table.columns, rows);
    }
    for (const StudyChart& chart : findings.charts)
      body += html_figure_svg(chart_svg(chart.chart), file_stem(study, chart.name), chart.caption);
    body += html_callout("Why. " + findings.why);
  }
  return html_page("The experiments of the thesis, done again", introduction, body);
}

fs::path write_studies(const std::vector<StudyResult>& results, const fs::path& folder,
                       const fs::path& markdown) {
  assert(!results.empty());
  const std::string page = results.size() == 1 ? results.front().study.name : "index";
  const fs::path text = markdown.empty() ? folder / (page + ".md") : markdown;
  const fs::path way = fs::absolute(folder).lexically_normal().lexically_relative(
      fs::absolute(text).lexically_normal().parent_path());
  std::string links = way.generic_string();
  if (links == "." || links.empty()) links.clear();
  if (!links.empty() && links.back() != '/') links += '/';

  std::vector<std::pair<fs::path, std::string>> files;
  for (const auto& [study, findings] : results) {
    for (const StudyTable& table : findings.tables)
      files.emplace_back(folder / (file_stem(study, table.name) + ".csv"), table_csv(table));
    for (const StudyChart& chart : findings.charts)
      files.emplace_back(folder / (file_stem(study, chart.name) + ".svg"),
                         svg_file(chart_svg(chart.chart)));
  }
  files.emplace_back(folder / (page + ".html"), studies_html(results));
  files.emplace_back(text, studies_markdown(results, links));
  for (const auto& [file, content] : files) write_text_file(file.string(), content);
  return folder / (page + ".html");
}

}  // namespace knotlight
