// What a model that understands would answer.
#pragma once

#include <string>

#include "scripting/sentences/meaning_of.h"

namespace stub {

// Whether a request's body asks what a sentence means.
bool asks_back(const std::string& body);
// The goal that the author's first sentence is, and the things that the meaning wants.
std::string right_answer(const std::string& body, const stampede::Meaning& meaning);

}  // namespace stub
