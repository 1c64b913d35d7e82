// What nearly every test includes, compiled once.
#pragma once

#include <catch2/catch.hpp>

#include "cmake/precompiled.h"
