// Reads an instruction: what it mentions, in which order things happen, what it denies.
//
// A parser of noun phrases and clauses by rules, with a lexicon that knows the scene: not of English, of what people
// say of a table. What it does not understand it says so of, and sentence_check turns it down.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scripting/language/meaning.h"

namespace stampede {

// Senses of nouns: what is there only once it is done.
inline const std::set<std::string> kBuilt = {"tower", "stack", "pile", "pyramid"};

// A noun phrase: `the three red blocks`, `the other cups`, `the blue one`.
struct Mention {
  std::size_t first = 0, head = 0;  // words, from the first of the phrase to its noun
  std::string sense;                // of the noun; of `one`: the noun before it
  std::set<std::string> modifiers;  // further nouns: knife block
  std::vector<std::string> colours, places, adjectives;
  std::optional<int> count;
  std::optional<int> total;              // `two of the three blocks`: three
  std::optional<std::size_t> placed_by;  // the word after it that says where it is: `the door on the left`
  bool plural = false;
  bool partitive = false;   // `of the blocks`: some of them are meant
  bool other = false;       // `the other blocks`
  std::string preposition;  // before it: on, into, from …
  bool aside = false;       // of a relative clause: the cup that stands on the table
  std::string role;         // `object put`, subject, to, from, of, with, or the preposition
  std::size_t segment = 0;
  std::vector<std::string> things;  // of the scene, that it may be
  bool by_head = false;             // the noun names them; else it is only a word of their names
};

// A stretch between commas and joining words.
struct Segment {
  std::size_t begin = 0, end = 0;
  std::string intro;                // after, before, until …; empty: none
  std::optional<std::size_t> verb;  // the word that says what to do
  bool negated = false, excluding = false;
};

struct Reading {
  std::vector<Word> words;
  std::vector<Mention> mentions;
  std::vector<Segment> segments;
  std::vector<std::size_t> in_time;  // segments in the order in which they happen: `b after a` is a, b
};

Reading read_sentence(const std::string& sentence, const Meaning& meaning);

// What sentences of one task differ in: the senses of a segment's words, in order, without grammar and politeness.
std::vector<std::string> content_of(const Reading& reading, std::size_t begin, std::size_t end);

}  // namespace stampede
