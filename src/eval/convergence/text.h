#pragma once
// Writes the results of the command `bench convergence` as a text table, CSV and JSON. Also reads and writes its
// journal, from which an interrupted run continues.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "eval/bench_subject.h"
#include "eval/convergence/crops.h"
#include "eval/convergence/rows.h"
#include "frame/driver/reference_image.h"

namespace defocus::engine {

// ---- text tables ----------------------------------------------------------------------------------------------------

std::string convergenceHeader();                         // returns the table's header, two lines
std::string convergenceLine(const ConvergenceRow& row);  // returns the table's line for a row
// Returns sentences about the reference, the rows on the Pareto front, the errors that more samples cannot reduce
// (BiasFloor), and the times to reach equal errors.
std::string convergenceSummary(std::span<const ConvergenceRow> rows, const ReferenceImage& reference);

// ---- measurement conditions and result files ------------------------------------------------------------------------

// Properties that all measured rows share: program, machine, scene, crops to show and skipped cases.
struct ConvergenceSubject {
    BenchSubject bench;
    std::vector<Crop> crops;
    struct LeftOut {
        std::string method;
        std::string setting;
        std::string reason;
    };
    std::vector<LeftOut> leftOut;
};

// Return the file names of a row's image and of its FLIP map, relative to the results folder.
std::string imageName(std::string_view method, std::string_view setting, std::uint32_t asked);
inline constexpr float errorMapFullScale = 0.25f;  // FLIP values above this have the map's brightest colour
std::string errorMapName(std::string_view method, std::string_view setting, std::uint32_t asked);

std::string convergenceCsv(std::span<const ConvergenceRow> rows);
std::string convergenceJson(std::span<const ConvergenceRow> rows, const ReferenceImage& reference,
                            const ConvergenceSubject& subject);

// ---- journal of measured runs ---------------------------------------------------------------------------------------

// Returns one CSV line per run, with numbers that are read back exactly. `subject`: hash of the properties that all
// runs of a journal share (scene, reference, device, program).
std::string runsCsv(std::span<const ConvergenceRun> runs, std::uint64_t subject);

// Returns the runs of a journal. The text may end at any byte: an incomplete last line is dropped. Throws Error, with
// the file `name` in its message, if the journal's hash differs from `subject` or a line is malformed.
std::vector<ConvergenceRun> readRunsCsv(std::string_view text, std::uint64_t subject, const std::string& name);

}  // namespace defocus::engine
