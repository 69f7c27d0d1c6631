#include "study/study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/errors.h"
#include "support/program.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

TEST(Studies, AreAllThereUnderNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Study& study : studies()) {
    EXPECT_TRUE(names.insert(study.name).second) << study.name;
    EXPECT_FALSE(study.title.empty() || study.place.empty() || study.thesis.empty());
  }
  EXPECT_EQ(names, (std::set<std::string>{"manufactured", "precision", "layouts", "singular-values",
                                          "svd-drivers", "oscillation", "radial-functions",
                                          "interior-points", "knots", "scaling", "inversion",
                                          "models", "rescaling", "flat-limit", "boundary-particle",
                                          "heterogeneous"}));
  EXPECT_EQ(chosen_studies("all").size(), names.size());
  EXPECT_EQ(chosen_studies("knots").front().name, "knots");
}

TEST(Studies, ABadNameIsAnsweredWithTheNearest) {
  try {
    chosen_studies("svd-driver");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'svd-drivers'"), std::string::npos)
        << error.what();
  }
}

class StudyCommand : public testing::Test {
 protected:
  test::ProgramResult run(const std::string& arguments) {
    return test::run_program(KNOTLIGHT_PROGRAM, "study " + arguments, scratch_.folder());
  }
  std::string read(const std::string& file) { return test::read_file(scratch_.path(file)); }

  test::ScratchFolder scratch_;
};

TEST_F(StudyCommand, RefusesBadNamesBeforeAnythingIsWritten) {
  for (const char* words : {"inversoin -o out", "knots", "-o out"}) {
    const test::ProgramResult result = run(words);
    EXPECT_EQ(result.exit_code, exit_bad_input) << words;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  EXPECT_NE(run("inversoin -o out").err.find("did you mean 'inversion'"), std::string::npos);
  EXPECT_EQ(run("inversion --quick -o out --markdown nowhere/page.md").exit_code, exit_bad_input);
  EXPECT_FALSE(std::filesystem::exists(scratch_.path("out")));
}

// Tables and charts have the same bits again, on any number of threads.
TEST_F(StudyCommand, WritesItsFilesAndTheSameOnesAgain) {
  EXPECT_EQ(run("oscillation --quick --threads 1 -o one").exit_code, exit_ok);
  EXPECT_EQ(run("oscillation --quick --threads 3 -o three --markdown page.md").exit_code, exit_ok);
  for (const char* file : {"/oscillation.csv", "/oscillation.svg", "/oscillation.html"}) {
    EXPECT_FALSE(read(std::string("one") + file).empty()) << file;
    EXPECT_TRUE(read(std::string("one") + file) == read(std::string("three") + file)) << file;
  }
  EXPECT_NE(read("one/oscillation.md").find("](oscillation.svg)"), std::string::npos);
  EXPECT_NE(read("page.md").find("](three/oscillation.svg)"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(scratch_.path("three/oscillation.md")));
}

// Without gnuplot nothing can be drawn, and nothing is written.
TEST_F(StudyCommand, FilesAreWrittenAllOrNone) {
  const test::ProgramResult result = test::run_program(
      "/usr/bin/env",
      std::string("PATH=/nowhere ") + KNOTLIGHT_PROGRAM + " study manufactured --quick -o out",
      scratch_.folder());
  EXPECT_EQ(result.exit_code, exit_failure);
  EXPECT_TRUE(std::filesystem::is_empty(scratch_.path("out")));
}

// Scenes that are not there are refused as scenes are elsewhere.
TEST_F(StudyCommand, ModelsNeedTheirScenes) {
  const test::ProgramResult result = run("models --quick -o out");
  EXPECT_EQ(result.exit_code, exit_bad_input);
  EXPECT_NE(result.err.find("bunny.yaml"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace knotlight
