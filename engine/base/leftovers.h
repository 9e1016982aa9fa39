// What a program that ends without being asked again would leave behind.
#pragma once

namespace stampede {

// All temporary folders of this process, whoever has them: only for who ends it at once.
void remove_leftovers();

}  // namespace stampede
