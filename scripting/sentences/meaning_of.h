// Meanings of a library's tasks, subgoals and labels, for sentences to be checked against.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/language/meaning.h"
#include "engine/record/record.h"

namespace stampede {

class Library;

// The author's sentences of every variation of a task.
std::vector<OwnSentences> sentences_of(const std::shared_ptr<const Library>& library, const std::string& task);

// Of a variation: what is said of its things holds in several starts (seeds `seed` to `seed` + 3). Makes one start in
// physics, as `stampede plan` does. `all`: of sentences_of. Throws Error where no start or no plan is found.
Meaning meaning_of(const std::shared_ptr<const Library>& library, const std::string& task, const std::string& variation,
                   std::int64_t seed, const std::vector<OwnSentences>& all);

// Of a label with slots, such as a skill's `pick up the {obj}`; `skill`: whose it is, or empty.
Meaning meaning_of_label(const Library& library, const std::string& name, const std::string& label,
                         const std::string& skill);

// Labels with slots that sentences of a level can be asked for, by name: of skills, of predicates (level world), of
// kinds of motions.
std::map<std::string, std::string> labels_of(const Library& library, LanguageLevel level);

// Which meaning is asked for: `of` is a variation at level task, a subgoal_key at level subgoal, else a name of
// labels_of.
struct MeaningKey {
  std::string task;
  LanguageLevel level = LanguageLevel::task;
  std::string of;
};
// Nothing where there is none of that name.
std::optional<Meaning> meaning_for(const std::shared_ptr<const Library>& library, const MeaningKey& key,
                                   std::int64_t seed, const std::vector<OwnSentences>& all);

}  // namespace stampede
