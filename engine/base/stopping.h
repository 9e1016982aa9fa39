// Whether somebody asked for an end: what runs long looks, however deep it lies.
#pragma once

#include "stampede/basics.h"

namespace stampede {

const std::atomic<bool>* stop_of_this_thread();  // for a thread that it starts
bool stop_asked();
void heed_stop();  // throws Interrupted where an end was asked for

}  // namespace stampede
