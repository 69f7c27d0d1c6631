#include "report/html.h"

#include <gtest/gtest.h>

namespace knotlight {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Html, EscapesWhatHasMeaning) {
  EXPECT_EQ(html_escape("a < b & \"c\" > 'd'"), "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  EXPECT_EQ(html_escape("λ ≥ 1"), "λ ≥ 1");
}

TEST(Html, PageIsWholeAndFetchesNothing) {
  const std::string page = html_page("A <title>", "Summary & more", html_paragraph("Text"));
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
  EXPECT_TRUE(contains(page, "<title>A &lt;title&gt;</title>"));
  EXPECT_TRUE(contains(page, "Summary &amp; more"));
  EXPECT_TRUE(contains(page, "<p>Text</p>"));
  for (const char* fetch : {"http", "src=", "@import", "<link", "<script"})
    EXPECT_FALSE(contains(page, fetch)) << fetch;
}

TEST(Html, TableAlignsNumbersAndMarksRows) {
  const std::string table = html_table(
      {"case", "error"}, {{"slab & box", "0.3 %"}, {"sphere", "-2e-3"}}, {"pass", "fail"});
  EXPECT_TRUE(contains(table, "<tr class=\"pass\"><td>slab &amp; box</td>"));
  EXPECT_TRUE(contains(table, "<td class=\"number\">0.3 %</td>"));
  EXPECT_TRUE(contains(table, "<tr class=\"fail\"><td>sphere</td><td class=\"number\">-2e-3</td>"));
}

TEST(Html, SvgNamesDoNotClashOnOnePage) {
  const std::string svg =
      "<svg><defs><circle id='dot'/><path id=\"p\"/></defs><use href='#dot' xlink:href=\"#p\" "
      "clip-path=\"url(#p)\"/></svg>";
  const std::string figure = html_figure_svg(svg, "one", "Caption");
  EXPECT_TRUE(contains(figure, "id='one-dot'"));
  EXPECT_TRUE(contains(figure, "id=\"one-p\""));
  EXPECT_TRUE(contains(figure, " href='#one-dot'"));
  EXPECT_TRUE(contains(figure, "xlink:href=\"#one-p\""));
  EXPECT_TRUE(contains(figure, "url(#one-p)"));
  EXPECT_TRUE(contains(figure, "<figcaption>Caption</figcaption>"));
}

TEST(Html, PicturesAreEmbedded) {
  const std::string figure = html_figure_png({'f', 'o', 'o'}, "a \"picture\"", "Caption");
  EXPECT_TRUE(contains(figure, "src=\"data:image/png;base64,Zm9v\""));
  EXPECT_TRUE(contains(figure, "alt=\"a &quot;picture&quot;\""));
}

}  // namespace
}  // namespace knotlight
