// The `study` command: the experiments of the thesis [V09 ch. 6.3, 7] done again. Each is a file of
// its own, <name>.cpp with '-' as '_', and has one shape: what the thesis says, the same measured
// after its method, the same as it should be, and why.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/run_options.h"
#include "report/chart.h"

namespace knotlight {

class LitBodies;

// Text, or a number; not-a-number: there is none.
using Cell = std::variant<std::string, double>;

struct StudyTable {
  std::string name;   // of its file after that of the study; empty for the main one
  std::string title;  // what the rows are and how they are measured
  // Seconds are processor time. Columns whose names start with that word differ from run to run;
  // all else has the same bits.
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;  // of as many cells as there are columns
};

struct StudyChart {
  std::string name;  // as StudyTable's
  Chart chart;
  std::string caption;
};

struct StudyFindings {
  std::vector<StudyTable> tables;
  std::vector<StudyChart> charts;
  std::string why;  // a paragraph
};

struct StudyOptions {
  bool quick = false;  // smaller and fewer; seconds
  // Where knot.yaml and bunny.yaml are, for the study of whole models.
  std::filesystem::path scenes = "scenes";
};

// What a study is given.
struct StudyBench {
  StudyOptions options;
  RunContext& run;
  LitBodies& bodies;  // answers that several studies measure against
};

struct Study {
  std::string name;
  std::string title;
  std::string place;   // in the thesis: "fig. 7.1"
  std::string thesis;  // what it says there, in words
  std::function<StudyFindings(StudyBench&)> run;
  std::vector<std::string> needs = {};  // files in StudyOptions::scenes
};

// In the order of the thesis's chapter 7, then its chapters 6.3, fig. 7.14 and 8.2.
const std::vector<Study>& studies();

// Those that a name stands for: one, or for `all` every one. InputError for any other name.
std::vector<Study> chosen_studies(const std::string& name);

struct StudyResult {
  Study study;
  StudyFindings findings;
};

// Runs them one after the other. InputError, before the first, if a file is missing.
std::vector<StudyResult> run_studies(const std::vector<Study>& chosen, const StudyOptions& options,
                                     RunContext& run);

}  // namespace knotlight
