#include "validate/validate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "core/errors.h"
#include "support/program.h"
#include "support/scene_files.h"
#include "validate/cases.h"
#include "validate/report.h"

namespace knotlight {
namespace {

Validation run_quick(int threads, const std::string& only) {
  RunOptions options;
  options.threads = threads;
  RunContext run(options, false);
  return validate({only, true}, run);
}

// Whether a factor is wrong is what tests/mutants asks; here, that nothing is.
TEST(Validate, QuickSelectionPasses) {
  const Validation validation = run_quick(0, "");
  EXPECT_GE(validation.cases.size(), 5U);
  EXPECT_EQ(validation.failed(), 0U) << validation_text(validation);
}

TEST(Validate, SameBitsForAnyNumberOfThreads) {
  Validation one = run_quick(1, "quick photons"), three = run_quick(3, "quick photons");
  for (Validation* v : {&one, &three})
    for (ValidatedCase& c : v->cases) c.seconds = 0.0;
  EXPECT_EQ(validation_csv(one), validation_csv(three));
}

TEST(Validate, CasesHaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const ValidationCase& c : validation_cases()) EXPECT_TRUE(names.insert(c.name).second);
}

TEST(Validate, AnUnknownNameIsWrongInput) {
  EXPECT_THROW(run_quick(1, "no such case"), InputError);
}

TEST(ValidationRow, WhatPasses) {
  ValidationRow row{"q", 1.1, 1.0, 0.1, 0.2, "", true};
  EXPECT_TRUE(row.passed());
  row.error = 0.3;
  EXPECT_FALSE(row.passed());
  row.judged = false;
  EXPECT_TRUE(row.passed());
  row.judged = true;
  row.error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(row.passed());
}

Validation made_up() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {{{"first, with a comma",
            {{"good", 1.001, 1.0, 0.001, 0.01, "reason", true},
             {"bad", nan, 1.0, nan, 0.01, "reason", true},
             {"model", 1.2, 1.0, 0.2, 0.0, "not judged", false}},
            {{"z", "U", {0.0, 0.5, 1.0}, {1.0, 2.0, 1.5}, {1.0, 2.1, 1.5}}},
            0.5}}};
}

TEST(ValidationReport, CountsAndVerdicts) {
  const Validation v = made_up();
  EXPECT_EQ(v.judged(), 2U);
  EXPECT_EQ(v.failed(), 1U);
  EXPECT_NE(validation_verdict(v).find("1 FAILED"), std::string::npos);
  const std::string text = validation_text(v);
  EXPECT_NE(text.find("FAIL"), std::string::npos);
  EXPECT_NE(text.find("0.1 %"), std::string::npos);
}

TEST(ValidationReport, CsvHasOneLinePerFigure) {
  const std::string csv = validation_csv(made_up());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_NE(csv.find("\"first, with a comma\",bad,nan,1,nan,0.01,reason,FAIL"), std::string::npos)
      << csv;
}

TEST(ValidationReport, JsonSaysNullForWhatIsNotFinite) {
  const auto json = nlohmann::json::parse(validation_json(made_up()));
  EXPECT_EQ(json["failed"], 1);
  const auto& figures = json["cases"][0]["figures"];
  EXPECT_TRUE(figures[1]["value"].is_null());
  EXPECT_EQ(figures[1]["passed"], false);
  EXPECT_FALSE(figures[2].contains("passed"));
}

// A failed figure that is not a number still gives a page.
TEST(ValidationReport, WritesTablesChartsAndPage) {
  const test::ScratchFolder scratch;
  const std::string folder = scratch.path("new/folder");
  write_validation(made_up(), folder);
  const std::string page = test::read_file(folder + "/validate.html");
  EXPECT_NE(page.find("first, with a comma"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(test::read_file(folder + "/validate.csv"), validation_csv(made_up()));
  EXPECT_NE(test::read_file(folder + "/validate-curves.csv").find("0.5,U,2,2.1"),
            std::string::npos);
  EXPECT_NE(test::read_file(folder + "/validate-first-with-a-comma-0.svg").find("<svg"),
            std::string::npos);
}

// The command: 0 if all passes, 2 for a name that no case has.
TEST(ValidateCommand, ExitCodes) {
  const test::ScratchFolder scratch;
  const auto good = test::run_program(KNOTLIGHT_PROGRAM, "validate --quick --only glowing -o out",
                                      scratch.folder());
  EXPECT_EQ(good.exit_code, exit_ok) << good.err;
  EXPECT_NE(good.out.find("quick glowing ball"), std::string::npos);
  EXPECT_FALSE(test::read_file(scratch.path("out/validate.html")).empty());
  const auto bad =
      test::run_program(KNOTLIGHT_PROGRAM, "validate --only nothing-like-it", scratch.folder());
  EXPECT_EQ(bad.exit_code, exit_bad_input);
  EXPECT_EQ(std::count(bad.err.begin(), bad.err.end(), '\n'), 1) << bad.err;
}

}  // namespace
}  // namespace knotlight
