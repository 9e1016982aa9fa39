// The research problems that a catalogue can serve, one row each: what a learner is given, what is kept from it, what
// it answers and how that is scored.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stampede::research {

enum class Part { all, train, test };  // train: with validation

// A table of a data set: a SELECT of db/datasets, for these episodes of it.
struct TableUse {
  std::string select;  // name of the file
  Part part = Part::all;
  std::string name = {};  // of the table, where it is not the file's
  const std::string& table() const { return name.empty() ? select : name; }
};

enum class AnswerType { integer, real, text };

// Without which a problem cannot be learned or scored: a given table needs rows of training, a hidden one rows of
// tests.
struct Need {
  std::string table, column = {};  // in which the rows have a value; empty: any row does
};

// A column of the answers. `optional`: it may be left out.
struct AnswerColumn {
  std::string name;  // `j*`: one for each joint of the arm (arm_joints.h)
  AnswerType type = AnswerType::text;
  std::string about;
  std::string example;  // empty: left out of the example of answers
  bool optional = false;
};

// What the rows of a data set are numbered by: whole episodes, or skill segments cut out of them.
enum class Unit { episode, piece };

struct ResearchProblem {
  std::string name;
  std::string serves;  // the row of Table I
  std::string title;   // one line
  Unit unit = Unit::episode;
  bool demos_only = true;  // failures are left out
  std::vector<TableUse> given = {}, hidden = {};
  std::vector<Need> needs = {};
  std::vector<AnswerColumn> answer = {};        // a row of the answers; empty: they are texts alone
  std::vector<AnswerColumn> answer_texts = {};  // beside the rows, such as a PDDL domain
  bool every_unit = true;                       // each test unit must be answered
  std::string scoring = {};                     // how, in sentences
  std::string scorer = {};                      // its name in all_scorers(); empty: measured by `stampede evaluate`
};

const std::vector<ResearchProblem>& all_problems();
const ResearchProblem& find_problem(std::string_view name);  // throws Error with the nearest name

}  // namespace stampede::research
