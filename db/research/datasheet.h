// The page that goes with each part of a data set, after Gebru et al., Datasheets for Datasets, CACM 2021,
// doi:10.1145/3458723: why it was made, what is in it, how it came about, how it is used and scored.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "db/research/dataset.h"

namespace stampede::research {

struct DatasheetFacts {
  std::string split;                            // the rule
  std::vector<std::string> tasks;               // in it
  std::vector<std::string> versions, numerics;  // of what made the episodes
  std::int64_t successes = 0, failures = 0, tries_undone = 0;
  std::int64_t recorded = 0;                      // of them of a real robot
  std::map<std::string, std::int64_t> labels;     // segments and facts, by who said them: simulator, person or model
  std::map<std::string, std::int64_t> sentences;  // by who wrote them: template, person or model
  bool pictures = false;
  std::vector<HeldOut> held_out;
  std::string where;  // which episodes of the catalogue, in SQL; empty: all
  std::string leaks;  // what training shows of what is held out, as Markdown
};
DatasheetFacts datasheet_facts(const Catalogue& catalogue, const std::vector<SplitEpisode>& episodes,
                               const Split& split, const SplitRule& rule);

std::string given_sheet(const ResearchProblem& problem, const DatasheetFacts& facts, const DatasetReport& report);
std::string hidden_sheet(const ResearchProblem& problem, const DatasheetFacts& facts, const DatasetReport& report);

}  // namespace stampede::research
