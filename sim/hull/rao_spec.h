// What a case says about a vessel that moves by displacement RAOs: the file and every convention that its numbers were
// written in. Nothing is assumed, because a wrong sign or reference still gives motions that look right.
#pragma once

#include <array>
#include <string>

#include "sim/spatial/pose.h"

namespace stillhook {

struct RaoSpec {
  enum class Format { csv, wamit };                     // named columns, or WAMIT's .4
  enum class Phase { lag, lead };                       // what a positive phase means
  enum class Event { crest, trough, rising, falling };  // of the wave at the phase origin, which phases are relative to
  enum class Direction { towards, from };               // what a heading of the file names
  enum class Turn { port, starboard };                  // the side to which headings grow, from the bow
  enum class Beyond { refuse, cut };  // waves outside the periods of the file: refused, or they move nothing
  std::string file;                   // resolved path
  Format format = Format::csv;
  Phase phase = Phase::lag;
  Event event = Event::crest;
  Direction direction = Direction::towards;
  Turn turn = Turn::port;
  std::array<bool, 6> reversed =
      {};  // motions that are positive aft, to starboard, down, port down, bow up, to starboard
  Vector3 reference = Vector3::Zero();  // m, in B: the point whose translation the file gives
  double phase_x = 0.0, phase_y = 0.0;  // m, in B: where the wave is that phases are relative to, at the mean pose
  enum class Column { period, frequency };
  Column column = Column::period;  // WAMIT: what the first column is
  double length = 1.0;             // m, WAMIT's ULEN
  int body = 0;                    // WAMIT: which body of the file, from 1; 0 = the only one
  bool port_starboard = false;     // the headings of one side stand for the other
  Beyond beyond = Beyond::refuse;

  bool operator==(const RaoSpec&) const = default;
};

}  // namespace stillhook
