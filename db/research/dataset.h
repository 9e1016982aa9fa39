// A catalogue's episodes as a data set for a research problem: what is given and what is hidden, in two folders.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "db/catalogue.h"
#include "db/plain_file.h"
#include "db/research/problem.h"
#include "db/research/split.h"

namespace stampede::research {

struct DatasetRequest {
  std::filesystem::path catalogue, given, hidden;  // hidden may be empty: that part is not written
  std::string split = "seeds";
  std::string where = {};  // which episodes, in SQL over view episodes; empty: all
};

struct DatasetReport {
  std::string id;  // hash of all that is in both parts
  std::int64_t train = 0, validation = 0, test = 0;
  std::int64_t given_rows = 0, hidden_rows = 0;
  std::string leaks;  // what training shows of what is held out, on one line; empty: nothing
};

// Writes given.db, README.md and answers.example.json into `given`, hidden.db and README.md into `hidden`. Episodes are
// numbered anew in an order that their keys give: the same episodes make the same bytes, whatever their numbers were.
// Throws Error where the catalogue has nothing to serve and for folders in which something else lies (a data set of the
// same problem is replaced), CatalogueError where files cannot be used.
DatasetReport make_dataset(const ResearchProblem& problem, const DatasetRequest& request);

// For folders that it made.
inline constexpr const char* kGivenFile = "given.db";
inline constexpr const char* kHiddenFile = "hidden.db";
std::string dataset_id(const PlainFile& file);
std::string dataset_problem(const PlainFile& file);

}  // namespace stampede::research
