//! What a shell and `man` know of the command line, made from its definition.

use std::io::Write;

use clap::CommandFactory;
use clap_complete::Shell;
use clap_mangen::Man;

use super::output::printed;
use super::{Arguments, CliError, Options, OutputFolder};

/// Writes the completions for a shell.
///
/// # Errors
/// [`CliError`] when `to` cannot be written; a closed pipe is none.
pub(super) fn completions(shell: Shell, to: &mut impl Write) -> Result<(), CliError> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "plummer", &mut script);
    printed(to.write_all(&script).and_then(|()| to.flush()))
}

/// Writes the manual page, or with `--out` that of every command as `plummer-COMMAND.1` into the folder.
///
/// # Errors
/// [`CliError`] when `to` or a file cannot be written.
pub(super) fn man(options: &Options, to: &mut impl Write) -> Result<(), CliError> {
    let command = Arguments::command();
    let Some(folder) = &options.out else {
        let mut page = Vec::new();
        printed(Man::new(command).render(&mut page))?;
        return printed(to.write_all(&page).and_then(|()| to.flush()));
    };
    let mut command = command;
    // pages name the whole command line: "plummer run"
    command.build();
    let mut pages = Vec::new();
    for part in command.get_subcommands().chain([&command]) {
        let name = part.get_bin_name().unwrap_or("plummer").replace(' ', "-");
        let mut page = Vec::new();
        printed(Man::new(part.clone().display_name(name.clone())).render(&mut page))?;
        pages.push((format!("{name}.1"), page));
    }
    let folder = OutputFolder::at(folder);
    let names: Vec<&str> = pages.iter().map(|(name, _)| &**name).collect();
    folder.claim_unless(&names, options.force, |_| Some(""))?;
    pages.iter().try_for_each(|(name, page)| folder.write(name, page).map(drop))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;
    use clap_complete::Shell;

    use super::{Arguments, Options, completions, man};

    #[test]
    fn every_command_is_completed_and_has_a_page() {
        let mut script = Vec::new();
        completions(Shell::Bash, &mut script).unwrap();
        let script = String::from_utf8(script).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let options = Options { out: Some(folder.path().to_owned()), ..Options::default() };
        man(&options, &mut Vec::new()).unwrap();
        for command in Arguments::command().get_subcommands() {
            let name = command.get_name();
            assert!(script.contains(&format!("plummer__subcmd__{name}")), "{name}");
            let page = folder.path().join(format!("plummer-{name}.1"));
            let page = std::fs::read_to_string(page).unwrap();
            assert!(page.contains(".SH OPTIONS") || page.contains(".SH SYNOPSIS"), "{name}");
        }
        let mut page = Vec::new();
        man(&Options::default(), &mut page).unwrap();
        assert!(String::from_utf8(page).unwrap().contains("plummer"));
    }
}
