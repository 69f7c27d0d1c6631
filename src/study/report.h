// Studies as files: tables, charts, a page for browsers and one for the repository.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/study.h"

namespace knotlight {

// A cell as people read it: three digits; "-" where there is no number.
std::string cell_text(const Cell& cell);
// The same for programs: every digit.
std::string table_csv(const StudyTable& table);

// A name of a table's or chart's file without its ending: NAME or NAME-PART.
std::string file_stem(const Study& study, const std::string& part);

// A Markdown page; `links` is the way from it to the folder of the charts, "" if it lies there.
std::string studies_markdown(const std::vector<StudyResult>& results, const std::string& links);
std::string studies_html(const std::vector<StudyResult>& results);

// Writes to `folder`, which must exist: a .csv per table, an .svg per chart, the page as index.html
// (of one study: NAME.html), and the Markdown page to `markdown`, or if that is empty beside it.
// Everything is drawn before the first file is written. Returns the HTML page's path. Throws
// std::runtime_error if gnuplot is missing.
std::filesystem::path write_studies(const std::vector<StudyResult>& results,
                                    const std::filesystem::path& folder,
                                    const std::filesystem::path& markdown);

}  // namespace knotlight
