#include "study/report.h"

#include <gtest/gtest.h>

#include "core/not_finite.h"

namespace knotlight {
namespace {

StudyTable table() {
  return {"part", "A title", {"way", "error"}, {{"a, b", 0.1}, {"c|d", nan}}};
}

std::vector<StudyResult> one_result() {
  Study study{"name", "title", "fig. 1", "It says so.", nullptr};
  StudyChart chart{"", {"Chart", "x", "y", false, false, {{"s", {1.0}, {1.0}, {}}}}, "Caption."};
  return {{study, {{table()}, {chart}, "Because."}}};
}

TEST(StudyReport, CellsAreShortForPeopleAndWholeForPrograms) {
  EXPECT_EQ(cell_text(0.12345678), "0.1235");
  EXPECT_EQ(cell_text(nan), "-");
  EXPECT_EQ(cell_text(std::string("text")), "text");
  EXPECT_EQ(table_csv(table()), "way,error\n\"a, b\",0.1\nc|d,nan\n");
}

TEST(StudyReport, MarkdownHasEveryPart) {
  const std::string text = studies_markdown(one_result(), "charts/");
  for (const char* part : {"## name", "Title (fig. 1).", "It says so.", "| way | error |",
                           "| c\\|d | - |", "![Chart](charts/name.svg)", "Caption.", "Because."})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(text.find("(#name)"), std::string::npos);
  std::vector<StudyResult> two = one_result();
  two.push_back(two.front());
  EXPECT_NE(studies_markdown(two, "").find("[name](#name)"), std::string::npos);
  EXPECT_EQ(file_stem(one_result()[0].study, "part"), "name-part");
}

TEST(StudyReport, PageHasEveryPart) {
  const std::string page = studies_html(one_result());
  for (const char* part : {"name: title (fig. 1)", "It says so.", "A title", "<svg", "Because."})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace knotlight
