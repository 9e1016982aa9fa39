#!/bin/bash
# What recipe.yaml runs: Lua and Bullet as the engine wants them, with Debian's names, then the engine and the package.
# shellcheck disable=SC2086,SC2154  # flags are words, and conda sets them
set -euo pipefail

own=$PWD/own
mkdir -p "$own/lib/pkgconfig" "$own/include"

for file in lua/src/*.c; do
  case $(basename "$file") in lua.c | luac.c) continue ;; esac
  "$CXX" $CXXFLAGS -x c++ -O2 -fPIC -DLUA_USE_POSIX -DLUA_USE_DLOPEN -c "$file" -o "${file%.c}.o"
done
"$AR" rcs "$own/lib/liblua5.4-c++.a" lua/src/*.o
mkdir "$own/include/lua"
cp lua/src/{lua,lauxlib,lualib,luaconf}.h lua/src/lua.hpp "$own/include/lua"
cat >"$own/lib/pkgconfig/lua5.4-c++.pc" <<PC
Name: lua5.4-c++
Description: Lua, compiled as C++
Version: 5.4
Cflags: -I$own/include/lua
Libs: -L$own/lib -l:liblua5.4-c++.a -ldl -lm
PC

cmake -S bullet -B bullet/build -G Ninja $CMAKE_ARGS -DCMAKE_INSTALL_PREFIX="$own" -DCMAKE_INSTALL_LIBDIR=lib \
  -DCMAKE_POLICY_VERSION_MINIMUM=3.5 -DCMAKE_BUILD_TYPE=Release -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_SHARED_LIBS=OFF \
  -DUSE_DOUBLE_PRECISION=ON -DBUILD_EXTRAS=OFF -DBUILD_UNIT_TESTS=OFF -DBUILD_CPU_DEMOS=OFF -DBUILD_BULLET2_DEMOS=OFF \
  -DBUILD_OPENGL3_DEMOS=OFF -DBUILD_PYBULLET=OFF -DINSTALL_LIBS=ON
cmake --build bullet/build --target install
cat >"$own/lib/pkgconfig/bullet-float64.pc" <<PC
Name: bullet-float64
Description: Bullet, in double precision
Version: 3.25
Cflags: -DBT_USE_DOUBLE_PRECISION -I$own/include/bullet
Libs: -L$own/lib -l:libBulletCollision.a -l:libLinearMath.a
PC

# The engine's build folder is the package's too (scripting/python/CMakeLists.txt).
export PKG_CONFIG_PATH=$own/lib/pkgconfig:$PREFIX/lib/pkgconfig CMAKE_PREFIX_PATH=$PREFIX
cmake --preset release $CMAKE_ARGS -DCMAKE_BUILD_TYPE=Release -DSTAMPEDE_TESTS=OFF -DSTAMPEDE_WERROR=OFF \
  -DDEJAVU_SANS="$PWD/dejavu/ttf/DejaVuSans.ttf"
"$PYTHON" -m pip install . -v --no-deps --no-build-isolation
