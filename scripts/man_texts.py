"""What man pages say beside options and entries. Exit statuses and files are those of docs/scene_files.md."""

MORE = {
    "platen": [
        "platen PROGRAM starts platen-PROGRAM, which has a page of its own. platen scenes lists the scenes that came with "
        "Platen, and prints the path of one that is named.",
    ],
    "platen-pack": [
        "The specimen is that of the scene's section Specimen: a cylinder, box, bar or disc, packed by an advancing front, grown to a "
        "random close packing, or read from a file. Density, coordination and isotropy of its contacts are told and written "
        "to summary.json.",
    ],
    "platen-bonds": [
        "The test is that of the scene's section Pair test: tension, compression, shear, cycles, combined opening and slip, bending, "
        "twisting. Load and displacement stand in bonds.csv.",
    ],
    "platen-bar": [
        "The test is that of the scene's section Bar test. Deflections and frequencies stand beside those of strength of "
        "materials.",
    ],
    "platen-compress": [
        "Platens are rigid or elastic, move or hold a stress, and rub; the specimen stands bare, in a rubber sleeve, under a "
        "pressure on its skin, or between four or six platens. History, cracks, acoustic events, frames for ParaView, checkpoints "
        "and a summary are written into the output folder.",
        "Results do not depend on the number of threads or ranks, nor on whether a run was stopped and resumed, to the byte. "
        "Under mpirun(1) one specimen is cut over the ranks.",
    ],
    "platen-brazilian": [
        "The disc lies on its rim; stress is 2 P / (pi D t). Output, checkpoints and options are those of platen-compress.",
    ],
    "platen-calibrate": [
        "Wanted numbers are those of the scene's section Calibrate. The parameters that were found are judged on packings that the search had "
        "not seen, and written to found.prm, a scene that can be run.",
    ],
    "platen-study": [
        "Kinds: friction, slenderness, size, packing, rate, accuracy, vary (any entries), target. Lists and seeds are those of the scene's section Study. A study may be made "
        "run by run over many machines: --plan, --run K, --collect.",
    ],
    "platen-report": [
        "The page is FOLDER/pictures/report.html, one file with everything in it: charts as SVG, with values under the pointer, and a "
        "view of the specimen that can be rotated. Each picture is written as PNG beside it, with --pictures each chart as PDF or SVG too. "
        "No display is needed.",
        "--laboratory draws a measured curve beside that of the run, with the differences in stiffness, strength and strain. The file is read "
        "as a laboratory writes it: any header that names stress or load and strain or displacement with their units, comma, semicolon or tab, "
        "decimal comma, %, per mille, kN and mm. --curve writes it as platen-calibrate reads it.",
        "For a study --laboratory takes a list: columns case, figure, value, and as needed unit, deviation, over, curve, a row for each measured figure. "
        "Figures agree within two scatters. --targets prints such a list as targets of platen-calibrate; its cases are then entries.",
        "--standard writes the test report by the standard that Scene/Standard names, FOLDER/pictures/test_report.html, for one or two sheets "
        "A4; what a simulation cannot know is left open by name.",
    ],
}

SHORT = {  # the line that whatis(1) prints
    "platen": "crush specimens of bonded spheres between platens: one word for all programs",
    "platen-pack": "pack spheres into a specimen and judge the packing",
    "platen-bonds": "test bonds between two or three spheres",
    "platen-bar": "pull, bend, twist and strike a bonded bar",
    "platen-compress": "crush, pull or bend a specimen of bonded spheres between platens",
    "platen-brazilian": "split a disc of bonded spheres along its diameter",
    "platen-calibrate": "find bonds that give wanted numbers",
    "platen-study": "run a sweep on several packings and table the results",
    "platen-report": "turn results into pictures and one HTML page",
}

COMMANDS_OF_PLATEN = [(name.removeprefix("platen-"), text[0].upper() + text[1:] + ".")
                      for name, text in SHORT.items() if name != "platen"] + [
    ("state FOLDER", "List what the newest checkpoint of a run holds; with a second folder report the first difference."),
    ("scenes NAME", "Print the path of a scene that came with Platen; without NAME list them."),
    ("--version", "Print version and libraries; with --json as JSON."),
    ("--help", "Print the programs and end."),
]

EXIT = {
    "all": [
        ("0", "Done."),
        ("1", "Done, but a number that the scene expects did not come out, or a target was missed."),
        ("2", "Bad input: command line, scene, or a file that they name. All faults are told with file and line; nothing was written."),
        ("3", "The numerics stopped, or runs of a study are missing: where, when and what to try. The last whole checkpoint is kept."),
        ("4", "Reading or writing failed during a run. Earlier results are untouched; --resume goes on."),
        ("129, 130, 143", "Stopped by SIGHUP, SIGINT or SIGTERM after a checkpoint; --resume goes on."),
    ],
    "platen": [
        ("0", "Done."),
        ("2", "Bad input: an unknown program, scene or option."),
        ("3", "The program cannot be started. Any other status is that of the program."),
    ],
    "platen-report": [
        ("0", "Done."),
        ("1", "With --state-diff: the checkpoints differ."),
        ("2", "Bad input: a folder without results, damaged or missing files, a laboratory's file that cannot be read."),
        ("4", "Writing failed."),
    ],
}

OF_RUNS = [
    ("scene.prm", "All entries as used; running it again gives the same bytes."),
    ("history.csv", "A row a sample: strains, stresses, broken bonds, energies."),
    ("cracks.csv", "A row for each broken bond."),
    ("crack_state.csv", "How wide each broken bond is at the end."),
    ("events.csv", "A row for each acoustic event."),
    ("summary.json", "Strength, moduli, damage, cones, pattern, costs; written last."),
    ("run.log", "What was told, with version, machine and threads."),
    ("specimen.pvd, bonds.pvd, platens.pvd, contacts.pvd, sleeve.pvd, cracks.vtu", "For ParaView."),
    ("view.py", "Shows them: pvpython view.py."),
    ("checkpoint/", "The two newest states of the run."),
]
OF_ALL = [("scene.prm", "All entries as used."), ("summary.json", "Results; written last."),
          ("run.log", "What was told, with version, machine and threads.")]

FILES = {
    "platen": [],
    "platen-pack": [("specimen.csv, specimen.vtu", "The spheres."),
                    ("specimen.yade.txt, specimen.data, specimen.dump", "The same, where the scene asks for it."),
                    ("directions.csv", "Contacts by direction."), *OF_ALL],
    "platen-bonds": [("bonds.csv", "Load paths."), *OF_ALL],
    "platen-bar": [("history.csv", "A row a sample of each load."), *OF_ALL],
    "platen-compress": OF_RUNS,
    "platen-brazilian": OF_RUNS,
    "platen-calibrate": [("found.prm", "The scene with what was found."), ("trials.csv", "A row for each run."),
                         ("curve.csv", "Curves that were wanted, and found."), *OF_ALL],
    "platen-study": [("study.csv, study.json", "A row a run; means and scatter of each case."), ("costs.csv", "What each run cost."),
                     ("plan.csv", "The runs, a line each (--plan)."), ("runs/", "Folders of the runs."), *OF_ALL],
    "platen-report": [("pictures/report.html", "The page."), ("pictures/*.png", "Pictures and charts; with --pictures charts as .pdf, .svg."),
                      ("fields.pvd", "With --fields: stress and damage on one grid, for ParaView.")],
}

ENVIRONMENT = [
    ("PLATEN_CACHE", "Folder of the cache of packings in place of ~/.cache/platen; none: no cache."),
    ("XDG_CACHE_HOME", "Folder of caches, where PLATEN_CACHE is not set."),
    ("OPENBLAS_NUM_THREADS", "Threads of the library for dense matrices; 1 where it is not set."),
]

SCENE = '"$(platen scenes {})"'
EXAMPLES = {
    "platen": [("platen scenes\nplaten compress " + SCENE.format("demo_dry"), "Lists the scenes; crushes a cylinder:")],
    "platen-pack": [("platen-pack " + SCENE.format("demo_dry") + " -o packed", "Packs the cylinder of a scene:")],
    "platen-bonds": [("platen-bonds " + SCENE.format("two_particles"), "Two bonded spheres:")],
    "platen-bar": [("platen-bar " + SCENE.format("bar_silica"), "A bar of fused silica:")],
    "platen-compress": [
        ("platen-compress " + SCENE.format("demo_dry") + " --dry-run", "Says what would run, and what it would cost:"),
        ("platen-compress " + SCENE.format("demo_dry") + ' -o mine -s "Platens/Friction static = 0.1"',
         "Crushes a cylinder between smoother platens:"),
        ('platen-compress --print-parameters Bond/Gap', "Tells one entry:")],
    "platen-brazilian": [("platen-brazilian " + SCENE.format("brazilian_concrete"), "Splits a disc:")],
    "platen-calibrate": [("platen-calibrate " + SCENE.format("calibrate_concrete"), "Finds bonds for a concrete of four numbers:")],
    "platen-study": [("platen-study friction " + SCENE.format("study_friction_quick") + " -o friction\nplaten-report friction",
                      "Friction of the platens on short and slender specimens:")],
    "platen-report": [("platen-report results/dry --compare results/greased", "A page of two runs, side by side:"),
                      ("platen-report envelope --laboratory mine.csv", "A study beside a laboratory's list of figures:")],
}
