//! Job scripts of a sweep or a data set for Slurm: an array of tasks, and the job that merges their results.

use std::ffi::OsString;
use std::path::Path;

use super::outputs::plain;
use crate::app::shell_word::shell_word;

/// The scripts, and how to submit them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SlurmScripts {
    /// The job array.
    pub array: String,
    /// The job after it, which merges.
    pub merge: String,
    /// A script that submits both, the second behind the first.
    pub submit: String,
}

/// Writes the scripts of a study in `folder`, by the command's word, with so many tasks. Task k takes points k, k + tasks, k + 2 tasks, ...: a task that
/// is submitted again goes on where it was stopped.
///
/// `program` are the words that call it, `folder` an absolute path; all machines of the cluster see both. `threads` are the cores of a
/// task.
pub(crate) fn slurm_scripts(
    command: &str,
    program: &[OsString],
    folder: &Path,
    tasks: usize,
    threads: usize,
) -> SlurmScripts {
    let words: Vec<String> = program.iter().map(|word| shell_word(&word.to_string_lossy())).collect();
    let (program_word, folder_word) = (words.join(" "), shell_word(&folder.to_string_lossy()));
    let name = folder.file_name().map_or_else(|| command.into(), |name| name.to_string_lossy());
    let name = plain(&name, |letter| letter.is_ascii_alphanumeric() || "_-.".contains(letter));
    let array = format!(
        "#!/bin/sh\n\
         #SBATCH --job-name={name}\n\
         #SBATCH --array=1-{tasks}\n\
         #SBATCH --ntasks=1\n\
         #SBATCH --cpus-per-task={threads}\n\
         # what is done is kept when a task is asked to end, and the next task on the same points goes on from it\n\
         #SBATCH --signal=TERM@60\n\
         #SBATCH --open-mode=append\n\
         # add what your cluster asks for: --partition, --account, --time, --mem\n\
         exec srun {program_word} {command} --task \"$SLURM_ARRAY_TASK_ID/{tasks}\" --threads {threads} {folder_word}\n"
    );
    let merge = format!(
        "#!/bin/sh\n\
         #SBATCH --job-name={name}-merge\n\
         #SBATCH --ntasks=1\n\
         exec {program_word} {command} --merge --force {folder_word}\n"
    );
    let submit = format!(
        "#!/bin/sh\n\
         # submits the array and, after all of its tasks, the merge\n\
         set -eu\n\
         cd {folder_word}/{command}\n\
         array=$(sbatch --parsable array.sbatch)\n\
         merge=$(sbatch --parsable --dependency=\"afterany:$array\" merge.sbatch)\n\
         echo \"array $array, merge $merge\"\n"
    );
    SlurmScripts { array, merge, submit }
}

#[cfg(test)]
mod tests {
    use std::ffi::OsString;
    use std::path::Path;

    use super::slurm_scripts;

    #[test]
    fn names_with_anything_in_them_stay_one_word() {
        let folder = Path::new("/data/it's; rm -rf ~/a $(b)");
        let scripts = slurm_scripts("sweep", &["/opt/py thon", "-m", "plummer"].map(OsString::from), folder, 12, 2);
        assert!(scripts.array.contains("#SBATCH --array=1-12\n"));
        assert!(scripts.array.contains("#SBATCH --cpus-per-task=2\n"));
        let word = r"'/data/it'\''s; rm -rf ~/a $(b)'";
        for script in [&scripts.array, &scripts.merge, &scripts.submit] {
            assert!(script.contains(word), "{script}");
        }
        assert!(scripts.array.contains("#SBATCH --job-name=a___b_\n"));
        assert!(scripts.array.contains("exec srun '/opt/py thon' -m plummer sweep --task \"$SLURM_ARRAY_TASK_ID/12\""));
    }
}
