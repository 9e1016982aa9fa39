// Reads an instruction: what it mentions, in which order things happen, what it denies.
//
// A parser of noun phrases and clauses by rules, with a lexicon that knows the scene: not of a language, of what people
// say of a table. What it does not understand it says so of, and a rule turns it down.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/language/meaning.h"

namespace stampede {

// A noun phrase: `the three red blocks`, `the other cups`, `the blue one`.
struct Mention {
  std::size_t first = 0, head = 0;  // words, from the first of the phrase to its noun
  std::string sense;                // of the noun; of `one`: the noun before it
  std::vector<std::string> colours, places, adjectives;
  std::vector<std::string> modifiers;  // further nouns: `knife` block
  std::optional<int> count;
  std::optional<int> total;              // `two of the three blocks`: three
  std::optional<std::size_t> placed_by;  // the word after it that says where it is: `the door on the left`
  bool plural = false;
  bool partitive = false;              // `of the blocks`: some of them are meant
  bool other = false;                  // `the other blocks`
  std::optional<std::size_t> after;    // the word of its preposition: on, into, from …
  bool aside = false;                  // of a relative clause: the cup that stands on the table
  std::string part;                    // object, subject, to, from, of, with, part, where, place, or the preposition
  std::string verb;                    // the sense of the verb that has it as this part
  std::optional<std::size_t> verb_at;  // and its word
  std::size_t segment = 0;
  std::vector<std::string> things;  // of the scene, that it may be
  ThingRoles roles;                 // of any of these
  bool by_head = false;             // the noun names them; else it is only a word of their names
  std::string role() const { return verb.empty() ? part : part + " " + verb; }
  bool acts() const { return part == "object" || part == "subject"; }  // it is what something is done to
};

// A stretch between commas and joining words.
struct Segment {
  std::size_t begin = 0, end = 0;
  std::optional<std::size_t> intro = {};  // the joining word: after, before, until …
  std::optional<std::size_t> verb = {};   // the word that says what to do
  bool negated = false, excluding = false;
};

struct Reading {
  std::vector<Word> words;
  std::vector<Mention> mentions;
  std::vector<Segment> segments;
  std::vector<std::size_t> in_time;  // segments in the order in which they happen: `b after a` is a, b

  std::span<const Word> words_of(const Segment& segment) const;
  std::span<const Mention> mentions_of(const Segment& segment) const;
  bool any(const Segment& segment, WordClass of) const;  // of its words
  bool at(const std::optional<std::size_t>& word, WordClass of) const { return word && words[*word].is(of); }
  const std::string& verb_of(const Segment& segment) const;  // its sense; empty: it has none
  bool is_possessor(const Mention& mention) const;           // `'s` follows
  bool ends_at(std::size_t word) const;                      // a stretch, with the word before
};

Reading read_sentence(const std::string& sentence, const Meaning& meaning);

// The steps of read_sentence, one after the other.
void read_pronouns(std::vector<Word>& words);               // `the blue one`, not `the one cup`: no number
void read_turns(Reading& reading, const English& english);  // `the red button first`: a turn, and no place
void read_light_verbs(Reading& reading, const Lexicon& lexicon);
void read_segments(Reading& reading);
void read_order(Reading& reading, const English& english);
void read_mentions(Reading& reading, const Meaning& meaning);

// What sentences of one task differ in: the senses of a segment's words, in order, without grammar and politeness.
std::vector<std::string> content_of(const Reading& reading, const Segment& segment);

}  // namespace stampede
