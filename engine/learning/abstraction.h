// Someone's predicates and operators in terms of those that made the data: the mapping is found.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/learning/counts.h"
#include "engine/learning/truth_table.h"
#include "engine/symbolic/symbols.h"

namespace stampede::learning {

// A true literal as the meaning of a learned atom, or one part of it.
struct LinkPart {
  std::string truth;
  std::vector<int> argument_of;      // by true argument: the learned argument that stands there, -1: none does
  std::vector<std::string> only_of;  // by true argument: where none does, the type that has one object in every scene;
                                     // empty: some object or other
  bool negated = false;
};

struct PredicateLink {
  std::string learned;
  std::vector<LinkPart> parts;  // all of them hold; none: it means nothing that the truth has a word for
  double agreement = 0;         // Matthews' correlation with that meaning, not negative
  double precision = 0, recall = 0;
  std::int64_t atoms = 0;  // that it was judged on
};

struct TypeLink {
  std::string learned, truth;  // a true type or trait; empty: none
  double overlap = 0;          // of their objects: both by either (Jaccard)
};

struct Mapping {
  std::vector<PredicateLink> links;  // by learned predicate, sorted
  std::vector<TypeLink> types;       // by learned type that the table has, sorted
  std::vector<std::string> missing;  // true predicates of `needed` that are part of no meaning
  double coverage = 0;               // of `needed`
};

// Every learned predicate is compared with every true one, or its negation, under every order of arguments, over all
// atoms that the table has: where one has more arguments than the other, these are such as are fixed (the hand) or
// anything. Matthews' correlation says how well they agree, times the share of the true facts that the table speaks of;
// who goes with whom is decided for all together (best_assignment). Two learned predicates may mean the same: the
// second gets what it agrees with by 0.8 or more. What agrees with no single literal by 0.9 is tried as two at once,
// among the 24 that best follow from it, and these must agree better by 0.05. Below `kLeastAgreement` there is no
// meaning, nor below four standard deviations of what chance gives, 4 / sqrt(n) but at most 0.95, n values without a
// change of the same atom counting as one. A row about a type of the learned domain says whose type it is; types go by
// their objects, from an overlap of 0.5 on. `needed`: predicates of the true domain that count. At most `most` frames
// are used, evenly chosen.
inline constexpr double kLeastAgreement = 0.2;
Mapping find_mapping(const Domain& learned, const Domain& truth, const std::vector<JudgedFrame>& frames,
                     const std::set<std::string>& needed, std::size_t most = 400);

// Mean agreement over true predicates: of the best link that each is part of; of none: 0. Of no predicates: 1.
double coverage_of(const Mapping& mapping, const std::set<std::string>& truths);

// The learned domain in true words, so that it can be compared, planned with and run as if it had been learned in them.
// An atom becomes the literals that it means. An argument that is fixed becomes a parameter of its type, another that
// the atom lacks is bound by `exists`, and by `forall` where a fact is removed. What means nothing is left out of
// conditions and effects; of two parts of which one is no more, the first is removed. What the learned domain derives
// stays derived, by its own definition in true words. `notes` say what was left out.
struct Translation {
  Domain domain;
  std::vector<std::string> notes;
};
Translation in_true_words(const Domain& learned, const Mapping& mapping, const Domain& truth);

// The predicates that preconditions and effects of these actions name.
std::set<std::string> predicates_of_actions(const Domain& domain, const std::set<std::string>& actions);

std::string to_text(const PredicateLink& link);  // grasped ?1 = (holding panda.hand ?1)

}  // namespace stampede::learning
