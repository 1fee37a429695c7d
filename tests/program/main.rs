//! The program from outside: its commands, the case files and results it reads and writes, and the pages it makes.

mod analyze;
mod case_schema;
mod command_line;
mod common;
mod condense_scenes;
mod dataset;
mod estimates;
mod examples;
mod export;
mod groups;
mod init;
mod inp;
mod long_run;
mod machines;
mod modes;
mod named_bearing;
mod report;
mod report_browser;
mod report_shapes;
mod results_schema;
mod several_bores;
mod sweep;
mod tube;
mod validator;
mod verify;
