//! Examples of the commands whose arguments are few, or beside their code.

pub(super) const MODES_EXAMPLE: &str = "\
Example: the published frequencies with the consistent equations instead of the printed ones
  plummer modes examples/tadina2011/beam.toml --set bearing.formulation=consistent --out out/consistent";

pub(super) const CONDENSE_EXAMPLE: &str = "\
Example: a housing on the nodes of its bore, its frequencies against those of the full model
  plummer condense examples/scenes/pedestal.toml --compare-full

Files:
  superelement.npz  k, m (interface first), labels, sensors (numpy.load); other formats: plummer export --to op4, mbdyn;
                    in another case [housing] superelement = \"superelement.npz\" puts it in the housing's place
  condense.json     checks with limits and verdicts, estimated errors

Large interfaces: condense.interface_modes = 30 in the case puts modes of the interface in the place of its coordinates. Only this
command does so: run, modes and frf keep the whole interface, export --to op4 and mbdyn refuse the key.";

pub(super) const FRF_EXAMPLE: &str = "\
Example: responses of the sensors to a force on the raceway, compared with the full model at the peaks
  plummer frf examples/transfer/pedestal.toml

Files:
  frf.json  receptances (m/N) of the reduced and, where compared, of the full model; what carries each path
  frf.uff   the same for test software (universal file, dataset 58)";

pub(super) const ANALYZE_EXAMPLE: &str = "\
Examples: a run of this program; a recorder's table, with a bearing by its drawing, and by its name; a run-up of a bearing with orders of a catalogue;
many files in one table
  plummer analyze out/outer-dent --window 1.0:2.6
  plummer analyze bench.csv --channel P1 --balls 9 --pitch-diameter 39.04 --ball-diameter 7.94 --speed 29.95
  plummer analyze bench.csv --channel P1 --bearing 6205 --speed 1797rpm
  plummer analyze rise.wav --orders BPFO=3.585,BPFI=5.415,BSF=2.357,FTF=0.398 --speed 0:600rpm,8:3000rpm --band 6000:12000
  plummer analyze records/*.csv --bearing 6205 --speed 1797rpm --out out/records

Signals: .npz (an array time_s, time or t, or a rate fs), .mat (MATLAB 5 to 7; the same), .csv, .txt, .tsv, .asc or .lvm (a column
time; units in the header: P1 (m/s^2); decimal points or commas), .wav, .uff or .unv (data sets 58 and 58b over time).

Several files: the table has a row for each file, channel and window. Every channel counts unless --channel names some. What
cannot be analysed has a row that says why, the others are analysed, and the exit code is 2.

Verdicts: fault indicated, not enough evidence, not seen. Each has its evidence and the probability that noise alone looks like it;
docs/diagnosis.md explains them. A window needs at least 16 events of a part: 7 shaft turns for most bearings.

Results of a run go into its own folder, of one file into out/ and its name, of several files into out/analysis.

Files:
  analysis.json  windows with strongest peaks and verdicts
  analysis.csv   a row for each window: RMS, kurtosis, verdict and reason; conclusion, probability and strength of each part
  report.html    signal, envelope, spectrum over orders, verdicts with harmonics and reasons; of several files their table, and
                 plots of up to 12 windows";

pub(super) const SWEEP_EXAMPLE: &str = "\
Examples: play and dent of the paper's bearing on all cores; the frequencies over the springs' stiffness; the first on a cluster
  plummer sweep examples/tadina2011/outer-dent.toml --vary bearing.radial_play=1e-6:4e-6:4 --vary 'bearing.defects[0].depth=5e-6,15e-6'
  plummer sweep examples/tadina2011/beam.toml --command modes --vary ring.nodes=36,72,144
  plummer sweep examples/tadina2011/outer-dent.toml --vary bearing.radial_play=1e-6:4e-6:4 --out out/play --slurm && sh out/play/sweep/submit.sh

Points that fail are listed and do not stop the others: the exit code is 0 if any point has a result. Ctrl-C keeps checkpoints;
the sweep goes on with --resume. Each point is a process with a folder of its own, DIR/sweep/NUMBER, as `plummer run` or
`plummer modes` leaves it.

Files:
  sweep.csv    a row for each point: values, state, wall time, figures of its result
  sweep.npz    the same as arrays (numpy.load); shape: the lengths of the axes, for reshape
  sweep.json   the axes; state, exit code and message of each point
  report.html  plots over what was varied, points that are not done, the table";

pub(super) const DATASET_EXAMPLE: &str = "\
Examples: 40 signals of two machines; going on after a stop, with more; on a cluster
  plummer dataset examples/datasets/two_machines.toml --count 40 --out out/signals
  plummer dataset examples/datasets/two_machines.toml --count 400 --out out/signals --resume
  plummer dataset examples/datasets/two_machines.toml --out out/signals --slurm=8 && sh out/signals/dataset/submit.sh

Every number follows from the seed and the signal's own number: any number of threads or tasks, and any stop, gives the same bytes. A
larger --count begins with the same signals. A signal that cannot be computed has its reason in the manifest, and the exit code is 1.

Files:
  signals-NNNNN.npz  signals (float32, a row each, m/s^2); label, split, machine, specimen, speed_hz, bpfo_hz, bpfi_hz, bsf_hz, ftf_hz
  manifest.json      what was drawn for each signal, its model with the estimated error, digests of files and inputs
  manifest.csv       the same as a table, a row for each signal; manifest.parquet: the same for pandas and others
                     (parquet = true in the specification: the signals too, signals-NNNNN.parquet)";

pub(super) const COMPLETIONS_EXAMPLE: &str = "\
Example: for bash, from the next shell on
  plummer completions bash > ~/.local/share/bash-completion/completions/plummer";

pub(super) const MAN_EXAMPLE: &str = "\
Examples: to read it; the pages of all commands, for man
  plummer man | man -l -
  plummer man --out ~/.local/share/man/man1";

pub(super) const REPORT_EXAMPLE: &str = "\
Example: the pages of results that an earlier version computed
  plummer report out/outer-dent

The command computes nothing and leaves the results as they are. It draws each page from its content, which lies beside it as
report.cbor.gz (CBOR, packed by gzip).";

pub(super) const VERIFY_EXAMPLE: &str = "\
Examples: the checks that take seconds; the orders of convergence too, which take half a minute
  plummer verify
  plummer verify --full --out out/full

Files, in out/verify unless --out names another folder:
  verify.json   checks with computed value, reference, source, assumptions, error, limit and verdict
  report.html   the same as tables; with --full the charts of orders";
