// Nothing: CMake compiles the headers of StampedeRoom.cmake with it, once for all rooms.
