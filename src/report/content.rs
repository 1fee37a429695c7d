//! What a report consists of, as plain data.

use serde::{Deserialize, Serialize};

use super::{Bars, Drawing, Matrix, ModeShapeView, Plot, Spans, StepMap, Table, Verdict};

/// A whole report, built step by step:
///
/// ```
/// use plummer::report::{Report, Section};
/// let html = Report::new("Housing A", "plummer run a.toml", "0.1.0")
///     .section(Section::new("Model").paragraph("Ring on 36 springs."))
///     .assumption("Rolling without slip.")
///     .to_html()?;
/// assert!(html.contains("Ring on 36 springs."));
/// # Ok::<(), plummer::report::ReportError>(())
/// ```
#[must_use]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Report {
    /// Title of the page.
    pub title: String,
    /// A line under the title, such as what the case is.
    pub subtitle: Option<String>,
    /// Command line that makes the report's results again.
    pub command: String,
    /// Version of the program.
    pub version: String,
    /// When the results were computed, as it is to be printed.
    pub date: Option<String>,
    /// Where the results come from and who answers for them.
    pub document: Option<Document>,
    /// The result as a whole: a few words and whether it is as it should be.
    pub judgement: Option<Headline>,
    /// The results in a few figures, on top.
    pub headlines: Vec<Headline>,
    /// The body.
    pub sections: Vec<Section>,
    /// Where the tables are beside the report, if they are.
    pub(crate) table_files: Option<TableFiles>,
    /// What was assumed, a sentence each.
    pub assumptions: Vec<String>,
    /// What the reader must know before trusting the results, a sentence each.
    pub warnings: Vec<String>,
}

/// The report's tables as files of their own.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct TableFiles {
    /// Their folder, seen from the report.
    pub folder: String,
    /// First word of their names.
    pub prefix: String,
}

/// A mesh file that the results rest on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct MeshFile {
    /// Its path as the case names it.
    pub path: String,
    /// Its hash with the name of the method ("SHA-256 9f86d0..."), if known.
    pub hash: Option<String>,
}

/// What stands in the head of a report beside title, date and version.
///
/// ```
/// use plummer::report::Document;
/// let head = Document::new().case("pedestal.toml").mesh("pedestal.msh", None).signed_by("Prepared by");
/// assert_eq!(head.signatures, ["Prepared by"]);
/// ```
#[must_use]
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Document {
    /// Case file.
    pub case: Option<String>,
    /// Hash of the case file with the name of the method, if known.
    pub(crate) case_hash: Option<String>,
    /// For whom and by whom the results are: names and texts.
    pub(crate) details: Vec<Fact>,
    /// Mesh files.
    pub meshes: Vec<MeshFile>,
    /// Lines to be signed by hand on paper ("Prepared by", "Checked by").
    pub signatures: Vec<String>,
}

/// One of the figures on top of a report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Headline {
    /// What it is.
    pub label: String,
    /// The figure, with its unit.
    pub value: String,
    /// Whether it is as it should be.
    pub verdict: Verdict,
    /// Its reason, in a sentence or two.
    #[serde(default)]
    pub note: Option<String>,
}

/// A numbered part of a report.
#[must_use]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// Title of the section.
    pub title: String,
    /// What it holds, in order.
    pub blocks: Vec<Block>,
}

/// A piece of a section.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Block {
    /// Free text.
    Paragraph(String),
    /// Properties in two columns.
    Facts(Vec<Fact>),
    /// A table.
    Table(Table),
    /// A plot of curves.
    Plot(Box<Plot>),
    /// A drawing of the model.
    Drawing(Drawing),
    /// A structure in space with its mode shapes.
    Shapes(Box<ModeShapeView>),
    /// A bar chart.
    Bars(Bars),
    /// A matrix in colours.
    Matrix(Matrix),
    /// Spans of one quantity.
    Spans(Spans),
    /// States over steps, conditions and methods.
    StepMap(StepMap),
}

/// A property of the model: name, value, and where it comes from or what it means.
#[must_use]
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fact {
    /// What it is.
    pub name: String,
    /// Its value, with its unit.
    pub value: String,
    /// Remark or source.
    pub note: Option<String>,
}

impl Fact {
    /// A property without a remark.
    pub fn new(name: impl Into<String>, value: impl Into<String>) -> Self {
        Self { name: name.into(), value: value.into(), note: None }
    }

    /// The property with a remark or a source.
    pub(crate) fn note(mut self, note: impl Into<String>) -> Self {
        self.note = Some(note.into());
        self
    }
}

impl Block {
    /// The plot, if it is one.
    pub(super) fn plot(&self) -> Option<&Plot> {
        match self {
            Self::Plot(plot) => Some(plot),
            _ => None,
        }
    }
}

impl Section {
    /// An empty section.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), blocks: Vec::new() }
    }

    /// The section with a piece more.
    pub(crate) fn block(mut self, block: Block) -> Self {
        self.blocks.push(block);
        self
    }

    /// The section with a paragraph more.
    pub fn paragraph(self, text: impl Into<String>) -> Self {
        self.block(Block::Paragraph(text.into()))
    }

    /// The section with a list of properties more.
    pub fn facts(self, facts: impl IntoIterator<Item = Fact>) -> Self {
        self.block(Block::Facts(facts.into_iter().collect()))
    }

    /// The section with a table more.
    pub fn table(self, table: Table) -> Self {
        self.block(Block::Table(table))
    }

    /// The section with a plot more.
    pub fn plot(self, plot: Plot) -> Self {
        self.block(Block::Plot(Box::new(plot)))
    }

    /// The section with a drawing more.
    pub(crate) fn drawing(self, drawing: Drawing) -> Self {
        self.block(Block::Drawing(drawing))
    }

    /// The section with a structure in space more.
    pub fn shapes(self, view: ModeShapeView) -> Self {
        self.block(Block::Shapes(Box::new(view)))
    }

    /// The section with a bar chart more.
    pub fn bars(self, bars: Bars) -> Self {
        self.block(Block::Bars(bars))
    }

    /// The section with a chart of spans more.
    pub fn spans(self, spans: Spans) -> Self {
        self.block(Block::Spans(spans))
    }

    /// The section with a matrix in colours more.
    pub fn matrix(self, matrix: Matrix) -> Self {
        self.block(Block::Matrix(matrix))
    }
}

impl Report {
    /// A report without contents.
    pub fn new(title: impl Into<String>, command: impl Into<String>, version: impl Into<String>) -> Self {
        Self { title: title.into(), command: command.into(), version: version.into(), ..Self::default() }
    }

    /// The report with a line under its title.
    pub(crate) fn subtitle(mut self, text: impl Into<String>) -> Self {
        self.subtitle = Some(text.into());
        self
    }

    /// The report with its tables as files beside it, `FOLDER/PREFIX-NUMBER-CAPTION.csv`; `Report::csv_files` gives
    /// their contents.
    pub fn tables_in(mut self, folder: impl Into<String>, prefix: impl Into<String>) -> Self {
        self.table_files = Some(TableFiles { folder: folder.into(), prefix: prefix.into() });
        self
    }

    /// The report with its date, as it is to be printed.
    pub fn date(mut self, text: impl Into<String>) -> Self {
        self.date = Some(text.into());
        self
    }

    /// The report with where its results come from and who answers for them.
    pub fn document(mut self, document: Document) -> Self {
        self.document = Some(document);
        self
    }

    /// The report with its result as a whole: what was judged, the outcome in a few words, and the verdict.
    pub fn judgement(mut self, label: impl Into<String>, value: impl Into<String>, verdict: Verdict) -> Self {
        self.judgement = Some(Headline { label: label.into(), value: value.into(), verdict, note: None });
        self
    }

    /// The report with a figure more on top.
    pub(crate) fn headline(mut self, label: impl Into<String>, value: impl Into<String>, verdict: Verdict) -> Self {
        self.headlines.push(Headline { label: label.into(), value: value.into(), verdict, note: None });
        self
    }

    /// The report with the reason of its last headline.
    pub(crate) fn note(mut self, note: impl Into<String>) -> Self {
        if let Some(last) = self.headlines.last_mut() {
            last.note = Some(note.into());
        }
        self
    }

    /// The report with a section more.
    pub fn section(mut self, section: Section) -> Self {
        self.sections.push(section);
        self
    }

    /// The report with an assumption more.
    pub fn assumption(mut self, text: impl Into<String>) -> Self {
        self.assumptions.push(text.into());
        self
    }

    /// The report with a warning more.
    pub(crate) fn warning(mut self, text: impl Into<String>) -> Self {
        self.warnings.push(text.into());
        self
    }
}

impl Document {
    /// A head without entries.
    pub fn new() -> Self {
        Self::default()
    }

    /// The head with the case file.
    pub fn case(mut self, path: impl Into<String>) -> Self {
        self.case = Some(path.into());
        self
    }

    /// The head with a mesh file more.
    pub fn mesh(mut self, path: impl Into<String>, hash: Option<String>) -> Self {
        self.meshes.push(MeshFile { path: path.into(), hash });
        self
    }

    /// The head with a line more to be signed.
    pub fn signed_by(mut self, role: impl Into<String>) -> Self {
        self.signatures.push(role.into());
        self
    }
}
