// Marks what the shared libraries show to programs; everything else stays hidden.
#pragma once

#define STAMPEDE_EXPORT __attribute__((visibility("default")))
