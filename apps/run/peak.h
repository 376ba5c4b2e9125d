// Did a test reach its peak, or did it only end?
#pragma once

#include <string>
#include <vector>

#include "coupling/program/program.h"

namespace platen::apps {

// A reading while the axis is loaded on. Strain and stress (Pa, the deviator) are positive in the sense of
// the test.
struct CurvePoint {
  double strain = 0, stress = 0;
  bool damaged = true; // a bond has broken since the axial loading began, or there are no bonds
  coupling::Loads by = coupling::Loads::by_closure;
};

enum class PeakKind {
  none,    // the stress still rose at the end, or nothing was borne
  fallen,  // it has fallen to 98 % of its largest
  plateau, // it has gained less than 1 % in the last fifth of the strain
};

constexpr const char *word_of(PeakKind kind) {
  return kind == PeakKind::fallen ? "fallen" : kind == PeakKind::plateau ? "plateau" : "not reached";
}

struct PeakOfCurve {
  PeakKind kind = PeakKind::none;
  double largest = 0, strain_of_largest = 0; // Pa, 1
  double strain_at_end = 0;                  // the largest strain that was reached
  double gained = 0;  // share that the largest stress has gained in the last fifth of the strain
  bool asked = false; // of a stress that was asked there: it stays, or gains, by command
  bool reached() const { return kind != PeakKind::none; }
};

// A fall counts where the strain has gone on; while a test is led by how the specimen widens, whose platens
// may part while it fails, it counts at any strain. Neither fall nor plateau counts before damage: platens
// that begin to move let the stress oscillate. A stress that stays because no more is asked is no plateau.
PeakOfCurve judge_peak(const std::vector<CurvePoint> &curve);

// "no peak was reached: ..."; empty where one was.
std::string words_against(const PeakOfCurve &peak);

} // namespace platen::apps
