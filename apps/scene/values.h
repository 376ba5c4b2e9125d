// Texts of a scene file to values and back: ranges, words, and the kinds of number that this format knows.
// Every function throws ValueError for a text that is no such value.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/quantity.h"
#include "apps/scene/scene.h"
#include "apps/scene/texts.h"
#include "base/range.h"

namespace platen::apps {

// A number with its unit, inside the range and what is physical; "" is NaN.
double read_quantity(const std::string &text, const std::string &si_unit, const Range &range);
// A whole number without a unit.
long read_integer(const std::string &text, const Range &range);
// on / off, true / false, yes / no.
bool read_flag(const std::string &text);
// "200" steps, "0.1 ms", "10 min"; 0 is none.
Interval read_interval(const std::string &text);
// "0.05 R_min", of less than a radius, or a length; not negative.
Gap read_gap(const std::string &text);
// "2" of the bond's, "4e5 N/m", and, where it is allowed, "0.01 bulk".
Stiffness read_stiffness(const std::string &text, bool bulk_allowed);
// "1 GPa, 2 GPa"; "" is no number.
std::vector<double> read_list(const std::string &text, const Quantity &each);
// "0.05 R_min, 0.1 mm"; "" is no gap.
std::vector<Gap> read_gaps(const std::string &text);
// "72 mm x 22.5 mm, 65 mm x 20 mm": heights and radii; "" is none.
std::vector<DomainSize> read_domains(const std::string &text);
// "dry steel, 0.1": words of Platens/Surface, or coefficients of friction; "" is none.
std::vector<StudySurface> read_surfaces(const std::string &text);
// "fast, standard": words of Scene/Quality; "" is none.
std::vector<Quality> read_qualities(const std::string &text);
// "Effects/Rotation = off, Platens/Degree = 2": path and value of each, tidied; "" is none.
std::vector<std::string> read_assignments(const std::string &text);
// "35 MPa ... 50 MPa", "... 0.1", "0.9 ..."; fills low and high, and the unit that is written there first.
Expectation read_expectation(const std::string &text, const std::string &si_unit, const Quantity &each);
// "cones, shear plane": any of `words`.
Expectation read_expected_words(const std::string &text, const std::vector<std::string> &words);
// "elastic, tension": words of calibrated_figures, each once; "" is none.
std::vector<CalibratedFigure> read_calibrated_figures(const std::string &text);
// The place of a word in `words`.
std::size_t read_word(const std::string &text, const std::vector<std::string> &words);

// What read_gap and read_stiffness take.
extern const char *const gap_allowed;
std::string stiffness_allowed(bool bulk_allowed);

std::string text_of(const Interval &interval);
std::string text_of(const Gap &gap);
std::string text_of(const Stiffness &stiffness);
std::string text_of(const StudySurface &surface);

} // namespace platen::apps
