// The steps of reference_parser, one after the other. Of this room alone.
#pragma once

#include "scripting/language/reference_parser.h"

namespace stampede {

extern const std::set<std::string> kJoins, kPrepositions;
bool is_article(const std::string& word);
// `the blue one`, not `the one cup`
bool is_pronoun_one(const std::vector<Word>& words, std::size_t i);

// `the red button first, the lime button second`: a turn, and no place.
void read_turns(std::vector<Word>& words);
// `get the tray into the oven`: put; `turn the lamp on`: switch. By what follows them.
void read_light_verbs(std::vector<Word>& words);
std::vector<Segment> segments_of(const std::vector<Word>& words);
std::vector<std::size_t> order_in_time(const std::vector<Word>& words, const std::vector<Segment>& segments);
// Of words and segments that are there.
void read_mentions(Reading& reading, const Meaning& meaning);

}  // namespace stampede
