// Which hulls feel each other's waves, and what a pairing that cannot be is told.
#include <catch2/catch.hpp>

#include "sim/hull/hydrodynamics.h"

using namespace stillhook;
using Catch::Matchers::Contains;

namespace {

/// Bodies by name, each with the one that it is coupled with.
std::vector<BodySpec> bodies_of(std::initializer_list<std::pair<const char*, const char*>> pairs) {
  std::vector<BodySpec> bodies;
  for (const auto& [name, other] : pairs) {
    bodies.emplace_back();
    bodies.back().name = name;
    bodies.back().hydrodynamics.coupled_with = other;
  }
  return bodies;
}

std::string refusal(const std::vector<BodySpec>& bodies) {
  try {
    coupled_hulls(bodies);
  } catch (const SpecificationError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("coupled hulls: a pair may be named by one of them or by both", "[hydrodynamics]") {
  using Groups = std::vector<std::vector<std::size_t>>;
  CHECK(coupled_hulls(bodies_of({{"crane", "barge"}, {"load", ""}, {"barge", ""}})) == Groups{{0, 2}, {1}});
  CHECK(coupled_hulls(bodies_of({{"crane", "barge"}, {"load", ""}, {"barge", "crane"}})) == Groups{{0, 2}, {1}});
}

TEST_CASE("coupled hulls: a pairing that cannot be is refused for what is wrong with it", "[hydrodynamics]") {
  CHECK_THAT(refusal(bodies_of({{"crane", "brage"}, {"barge", ""}})), Contains("there is no body 'brage'"));
  CHECK_THAT(refusal(bodies_of({{"crane", "crane"}})), Contains("cannot be coupled with itself"));
  CHECK_THAT(refusal(bodies_of({{"crane", "barge"}, {"tug", "barge"}, {"barge", ""}})),
             Contains("bodies.tug") && Contains("'barge' is coupled already"));
  CHECK_THAT(refusal(bodies_of({{"crane", "barge"}, {"barge", "tug"}, {"tug", ""}})),
             Contains("bodies.barge") && Contains("'barge' is coupled already"));
}
