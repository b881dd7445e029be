// SPDX-License-Identifier: BSD-3-Clause
// Reasons why files cannot be read or written. A text follows "Cannot read 'PATH': ",
// see io/files.h, so it begins with a lower-case letter.
#include "common/message_texts.h"

#include <iterator>

namespace pcl_uvol::detail {

namespace {

const MessageText file_error_rows[] = {
    // the system
    {"system_error", "{reason}."},
    {"library_error", "{library} says '{reason}'."},
    {"no_such_file", "there is no such file."},
    {"no_matching_file", "no file matches."},
    {"no_required_file", "it requires the file '{file}', which does not exist."},
    {"is_directory", "it is a directory."},
    {"not_regular_file", "it is not a regular file."},
    {"no_folder", "there is no folder '{folder}'."},
    {"not_a_folder", "'{folder}' is not a folder."},
    {"empty_file", "the file is empty."},
    {"shortened_file", "the file became shorter while it was read."},
    {"too_large_for_memory", "there is not enough memory for it."},
    {"full_disk", "the disk may be full."},
    {"not_unpacked",
     "it cannot be unpacked into a temporary file: {reason}. Try: TMPDIR to name "
     "another folder."},
    {"no_temporary_file",
     "no temporary file can be made in '{folder}': {reason}. Try: TMPDIR to name "
     "another folder."},
    {"library_missing",
     "this build does not read {format}, because it lacks the library. Try: convert "
     "the file{is_packed| to .gz|}."},

    // formats
    {"no_ending",
     "its name has no ending. Formats: .pcd, .ply, text, VTK, .las, .npy, .npz, "
     ".nc, .bgeo, PLOT3D, Exodus, EnSight, OpenFOAM, HDF5 and Gadget."},
    {"unknown_ending",
     "the ending '{ending}' is not known{has_similar|, but {similar} is|}. Formats: "
     ".pcd, .ply, text, VTK, .las, .npy, .npz, .nc, .bgeo, PLOT3D, Exodus, EnSight, "
     "OpenFOAM, HDF5 and Gadget."},
    {"convertible_ending", "the ending '{ending}' is not known; {way}."},
    {"other_ending", "{what} are read from {endings}."},
    {"unwritten_ending", "{what} are written as {endings}."},
    {"packed_output", "packed files are read, but not written."},
    {"not_streamable",
     "{what} have to be read whole; files that are read in blocks are snapshots, "
     "arrays, PCD (ascii or binary, not compressed), PLY and text tables."},
    {"wrong_start", "it is not {format}: it does not begin with {start}."},
    {"not_format", "it is not {format}, or it is damaged."},
    {"not_text_file", "it is not a text file: it contains a byte of value {byte}."},
    {"unsupported_value", "{what} is '{value}', but only {known} can be read."},
    {"packed_points",
     "its points are packed (LAZ). Try: laszip -i in.laz -o out.las to unpack them."},
    {"houdini_12",
     "it is a .bgeo of Houdini 12 or newer; older ones can be read. Try: .bhclassic, "
     "saved by Houdini."},
    {"houdini_primitives",
     "it contains curves or surfaces (primitives of kind {kind}), but only particles "
     "can be read. Try: Houdini's Add node, which keeps the points."},
    {"vtkhdf_type",
     "its type is '{type}', but PolyData, UnstructuredGrid and ImageData can be "
     "read. {has_part|Try: name a part of it, as in file.vtkhdf:'{part}'|ParaView "
     "saves others as .vtu}."},
    {"several_times",
     "it contains {what} of several times; one can be read. Try: {ending}, saved by "
     "ParaView for one time."},

    // parts
    {"truncated_part", "it is truncated or damaged: {part} is not complete."},
    {"truncated_data",
     "it is truncated or damaged: its header promises {promised} {things}, but only "
     "{bytes} bytes follow."},
    {"truncated_rows",
     "it is truncated or damaged: its header promises {promised} {things}, but only "
     "{rows} follow."},
    {"missing_part", "it is incomplete: {part} is missing."},
    {"damaged_compression", "its compressed data are damaged or truncated."},
    {"invalid_part", "it is damaged: {part} is not valid."},
    {"repeated_part", "{part} is given twice."},
    {"missing_target", "it is damaged: {part} names {target} that does not exist."},
    {"disagreeing_parts", "{parts} do not agree."},
    {"wrong_count", "{what} has {count} {things}, but {expected} are expected."},
    {"too_many_parts", "{what} has more than {most} {things}."},
    {"uncountable", "it has more {things} than can be numbered."},
    {"nothing_inside", "it contains no {things}."},
    {"other_content", "it contains {found}, but {expected} are expected."},
    {"endless_lists", "its lists name one another without end."},

    // lines
    {"unexpected_word", "'{word}' is not {expected}."},
    {"text_in_column", "'{word}' in column '{column}' is not a number."},
    {"foreign_line", "the line does not belong to {part}."},
    {"incomplete_entry", "{what} requires {parts}."},
    {"numbers_unlike_header",
     "the line has {too_few|fewer|more} numbers than the header promises."},
    {"open_quote", "a quote does not end."},
    {"text_behind_quote", "there is text behind a closing quote."},

    // scenes
    {"unknown_word", "unknown word '{word}'; {kinds} are {known}."},
    {"missing_word", "{what} is missing; write '{form}'."},
    {"exclusive_words", "'{one}' cannot be combined with '{other}'."},
    {"bright_material",
     "the material '{material}' reflects and lets through more than all light: reflect "
     "and transparent are 1 together at most."},
    {"endless_inclusion", "a file includes itself: {files}."},

    // coordinates
    {"few_columns",
     "it has {columns} columns, and coordinates need three, separated by comma, "
     "semicolon, tab or blanks."},
    {"some_coordinates_named",
     "its header names only some of x, y and z, for example '{column}'. Try: name the "
     "coordinate columns, or give their numbers ({-xyz})."},
    {"only_times_named",
     "its header names no coordinates but times. Try: name the coordinate columns, or "
     "give their numbers ({-xyz})."},
    {"z_is_missing",
     "it has x and y but no z. Try: add a z column, for example 0 for samples in a "
     "plane."},
    {"coordinate_below_limit",
     "its coordinate {column} has values below a limit, for example <0.25."},
    {"ambiguous_integers",
     "its header names no coordinates, and integers as in '{column}' are ambiguous. "
     "Try: names or numbers of the coordinate columns ({-xyz})."},
    {"no_coordinate_column",
     "there is no column '{column}' for a coordinate; the columns are '{first}' to "
     "'{last}', or 0 to {most}."},
    {"repeated_coordinate_column", "the coordinates require three different columns."},
    {"no_time", "it has no header that names its time, which {pattern} represents."},
    {"tecplot_blocks",
     "its zone has BLOCK packing. Try: write it with DATAPACKING=POINT."},
    {"no_point_array",
     "points are arrays with a row per point and 3 to {most} columns, x, y and z "
     "first, "
     "or with named fields."},
    {"no_position_array", "no array of it has a usual name of coordinates ({names})."},
    {"no_usual_coordinates",
     "it has no tables x, y, z, Coordinates, positions or pos{has_group| in "
     "'{group}'|}. Try: name your coordinates, as in file.h5:/group/x,y,z."},
    {"not_coordinate_tables",
     "'{name}' names neither a group, nor one table of positions, nor three of "
     "coordinates."},
    {"no_netcdf_coordinates",
     "no variables of it are longitude and latitude, or x and y, by their standard "
     "names, units or names; there are {variables}."},

    // snapshots and HDF5
    {"no_particles",
     "it contains no particles{has_kind| '{kind}'; there are {others}|}."},
    {"snapshot_without_number",
     "it is one of {files} files of a snapshot, whose names should differ in a number, "
     "as in snap.0{ending}."},
    {"unknown_snapshot",
     "{-particles} requires a snapshot, and the file is not a known snapshot."},
    {"filter_not_installed",
     "'{name}' is compressed by the HDF5 filter {filter} ({id}), which is not "
     "installed. Try: h5repack -f GZIP=4 on a machine with the filter."},
    {"long_hdf5_name", "a name in it is longer than HDF5 allows."},
    {"large_npz", "a .npz file is limited to 4 GB. Try: .ply or .vtp."},

    // volumes
    {"not_scalar_volume", "it is not a volume of one number per point in 3-D."},
    {"shared_layers", "its {layers} layers cannot be shared by {files} files of data."},
    {"turned_axes",
     "its axes are not parallel to x, y and z in this order. Try: resample it to such "
     "axes first."},
    {"slice_pattern",
     "'{pattern}' and its numbers do not name files; slices are named as in "
     "'slice%03d.raw 1 20 1': one %d, first, last and step."},

    // VTK
    {"swapped_bytes",
     "the numbers of '{name}' are in the byte order of this machine, but legacy VTK "
     "files are big-endian. Try: write it as big-endian or .vtu."},
    {"many_vtp_fields",
     "{fields} fields are too many: a .vtp has {most} at most, a .vtkhdf any number."},
    {"reader_not_started",
     "another process that reads it could not be started: {reason}."},
    {"reader_too_slow",
     "the reader of VTK takes more than {seconds} s for it: it is damaged."},
    {"reader_too_large",
     "the reader of VTK takes more than {megabytes} MB of memory for it: it is "
     "damaged."},
    {"reader_failed", "the reader of VTK fails on it: it is damaged."},
};

} // namespace

MessageTexts
listFileErrors()
{
  return {std::begin(file_error_rows), std::end(file_error_rows)};
}

} // namespace pcl_uvol::detail
