// The entries one below the other, in a list that scrolls; above and below it what belongs to all of them.
#include "widgets/preferences_view.hpp"

#include "widgets/choice_row.hpp"
#include "widgets/labels.hpp"
#include "widgets/row_area.hpp"
#include "widgets/sheet_button.hpp"
#include "widgets/touch_line.hpp"

#include <QHBoxLayout>
#include <QLineEdit>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

constexpr std::array<int, 4> pauses{30, 60, 90, 120};           // s
constexpr std::array<int, 6> strengths{0, 20, 40, 60, 80, 100}; // %

template <typename Number, std::size_t n>
int placeOf(const std::array<Number, n>& values, Number value)
{
    const auto place = std::find(values.begin(), values.end(), value);
    return place == values.end() ? -1 : int(place - values.begin());
}

template <typename Number, std::size_t n>
QStringList numbers(const std::array<Number, n>& values, const QString& pattern)
{
    QStringList texts;
    for (const Number value : values)
        texts << pattern.arg(value);
    return texts;
}

QString languageName(const QString& language)
{
    if (language == QLatin1String("en"))
        return QStringLiteral("English");
    return language == QLatin1String("zh_CN") ? QStringLiteral("\u7B80\u4F53\u4E2D\u6587") : PreferencesView::tr("as the computer");
}

QString holdName(int pictures)
{
    return pictures > 1 ? PreferencesView::tr("mean of %1").arg(pictures) : PreferencesView::tr("the last picture");
}

QString heightName(int millimetres) { return PreferencesView::tr("%1 cm").arg(millimetres / 10.0, 0, 'f', 1); }

} // namespace

PreferencesView::PreferencesView(QWidget* parent)
    : QFrame(parent),
      m_leave(new SheetButton(tr("To the cockpit  F1"), SheetButton::Enter::Clicks, this)),
      m_about(new SheetButton(tr("About"), SheetButton::Enter::Clicks, this)),
      m_defaults(new SheetButton(tr("Restore defaults"), SheetButton::Enter::Ignored, this)),
      m_state(plainLabel({}, TextRole::Body, this)),
      m_overruled(plainLabel({}, TextRole::Caption, this))
{
    setAccessibleName(tr("Preferences"));
    setAutoFillBackground(true);
    setFocusProxy(m_leave);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(18, 12, 14, 10);
    column->setSpacing(6);
    makeHead(column);
    column->addWidget(makeEntries(), 1);
    makeFoot(column);
    setPreferences({});
    setReadOnly({});
    setOverruled({});
}

void PreferencesView::makeHead(QVBoxLayout* column)
{
    QLabel* title = plainLabel(tr("Preferences"), TextRole::Title, this);
    setInk(title, colour::bright);
    column->addWidget(title);
    m_state->setWordWrap(true);
    m_overruled->setWordWrap(true);
    setInk(m_overruled, colour::secondary);
    column->addWidget(m_state);
    column->addWidget(m_overruled);
}

QWidget* PreferencesView::makeEntries()
{
    auto* area = new RowArea(tr("Entries"), this);
    auto* body = new QWidget(area);
    auto* column = new QVBoxLayout(body);
    column->setContentsMargins(0, 4, 4, 4);
    column->setSpacing(12);
    addGeneral(column);
    addPictures(column);
    addHold(column);
    addLengths(column);
    column->addStretch(1);
    area->setWidget(body);
    return area;
}

ChoiceRow* PreferencesView::addChoice(QVBoxLayout* column, const QString& name, const QString& whatItDoes, const QStringList& choices)
{
    auto* row = new ChoiceRow(name, whatItDoes, choices, this);
    column->addWidget(row);
    return row;
}

template <typename Change>
void PreferencesView::ask(Change change)
{
    Preferences wanted = m_preferences;
    change(wanted);
    if (!m_readOnly && wanted != m_preferences)
        Q_EMIT changed(withinBounds(wanted));
}

void PreferencesView::addGeneral(QVBoxLayout* column)
{
    QStringList names;
    for (const QString& language : preferenceLanguages())
        names << languageName(language);
    m_language =
        addChoice(column, tr("Language"), tr("Of everything on this screen. Takes effect when the console is started next."), names);
    m_brightness = addChoice(column, tr("Brightness"),
                             tr("Of what surrounds the pictures. The pictures and the alarms' colours are the same in each."),
                             {word(Brightness::Dim), word(Brightness::Usual), word(Brightness::Bright)});
    m_pause = addChoice(column, tr("Audio pause"), tr("How long F9 silences alarms. A new high alarm ends it; 120 s is the site's limit."),
                        numbers(pauses, tr("%1 s")));
    m_span = addChoice(column, tr("Trends"), tr("The span that the trends begin with; their own button changes it at any time."),
                       {tr("60 s"), tr("10 min")});
    m_patientSide = addText(column, tr("Patient side"), tr("How you call the people there; the prompt of a lost link shows it."),
                            tr("name and telephone number"), Preferences::mostContact);
    connect(m_patientSide, &QLineEdit::editingFinished, this,
            [this] { ask([this](Preferences& p) { p.patientSide = m_patientSide->text().trimmed(); }); });
    connect(m_language, &ChoiceRow::chosen, this,
            [this](int i) { ask([i](Preferences& p) { p.language = preferenceLanguages().at(i); }); });
    connect(m_brightness, &ChoiceRow::chosen, this, [this](int i) { ask([i](Preferences& p) { p.brightness = Brightness(i); }); });
    connect(m_pause, &ChoiceRow::chosen, this,
            [this](int i) { ask([i](Preferences& p) { p.audioPause = std::chrono::seconds(pauses.at(std::size_t(i))); }); });
    connect(m_span, &ChoiceRow::chosen, this, [this](int i) { ask([i](Preferences& p) { p.trendSpan = TrendSpan(i); }); });
}

void PreferencesView::addPictures(QVBoxLayout* column)
{
    m_folder = addText(column, tr("Folder of pictures"),
                       tr("Where \u201CSave\u201D under a picture writes to; Enter takes it. It is made when it is missing."),
                       tr("liena, in your folder of pictures"), Preferences::mostFolder);
    m_rate = addChoice(column, tr("X-ray pulses"),
                       tr("Pictures per second while the pedal is down; the dose grows with them. A recorded run keeps its own rate."),
                       numbers(pulseRates, tr("%1 /s")));
    QStringList windows;
    for (int i = 0; i < int(WindowChoice::Fixed); ++i)
        windows << word(WindowChoice(i));
    m_window = addChoice(column, tr("Window"),
                         tr("Brightness and contrast that pictures begin with. The picture's own controls change it."), windows);
    m_noise = addChoice(column, tr("Noise reduction"),
                        tr("That pictures begin with. It mixes pictures of before in, so movement is shown later; the age counts it, and "
                           "less is mixed in where the age limit leaves no room."),
                        numbers(strengths, tr("%1 %")));
    m_edge = addChoice(column, tr("Edges"), tr("Enhancement of edges that pictures begin with."), numbers(strengths, tr("%1 %")));
    m_edgeMethod = addChoice(column, tr("Edges by"),
                             tr("The unsharp mask raises what is as wide as a wire, multi-scale raises weak detail of every size and takes "
                                "more of this computer. Neither raises noise."),
                             {word(EdgeMethod::UnsharpMask), word(EdgeMethod::MultiScale)});
    connect(m_folder, &QLineEdit::editingFinished, this,
            [this] { ask([this](Preferences& p) { p.pictureFolder = m_folder->text().trimmed(); }); });
    connect(m_rate, &ChoiceRow::chosen, this, [this](int i) { ask([i](Preferences& p) { p.pulseRate = pulseRates.at(std::size_t(i)); }); });
    connect(m_window, &ChoiceRow::chosen, this, [this](int i) { ask([i](Preferences& p) { p.window = WindowChoice(i); }); });
    connect(m_noise, &ChoiceRow::chosen, this,
            [this](int i) { ask([i](Preferences& p) { p.noiseReduction = strengths.at(std::size_t(i)); }); });
    connect(m_edge, &ChoiceRow::chosen, this, [this](int i) { ask([i](Preferences& p) { p.edge = strengths.at(std::size_t(i)); }); });
    connect(m_edgeMethod, &ChoiceRow::chosen, this, [this](int i) { ask([i](Preferences& p) { p.edgeMethod = EdgeMethod(i); }); });
}

void PreferencesView::addHold(QVBoxLayout* column)
{
    QStringList holds;
    for (const int pictures : holdCounts)
        holds << holdName(pictures);
    m_hold =
        addChoice(column, tr("Last image hold"),
                  tr("What is held when a run ends. A mean of its last pictures has less noise, and what moved is blurred in it. It says "
                     "how many went in; those of another exposure or place do not."),
                  holds);
    connect(m_hold, &ChoiceRow::chosen, this,
            [this](int i) { ask([i](Preferences& p) { p.holdPictures = holdCounts.at(std::size_t(i)); }); });
}

void PreferencesView::addLengths(QVBoxLayout* column)
{
    QStringList heights;
    for (const int height : objectHeights)
        heights << heightName(height);
    m_object = addChoice(column, tr("Object's height"),
                         tr("How far above the table what is measured lies, about half of what the patient is thick. Lengths in a plane "
                            "above the table, Plane or O while measuring, begin with it."),
                         heights);
    m_tableTop = addText(column, tr("Table top"),
                         tr("In mm below the isocentre at the reported table height 0. Without it: no such plane."), tr("not set up"), 5);
    connect(m_object, &ChoiceRow::chosen, this,
            [this](int i) { ask([i](Preferences& p) { p.objectHeight = objectHeights.at(std::size_t(i)); }); });
    connect(m_tableTop, &QLineEdit::editingFinished, this, &PreferencesView::takeTableTop);
}

/// What is no such number is not taken for another one: what was in force comes back.
void PreferencesView::takeTableTop()
{
    const QString text = m_tableTop->text().trimmed();
    bool good = false;
    const int millimetres = text.toInt(&good);
    if (!text.isEmpty() && !(good && std::abs(millimetres) <= Preferences::farthestTableTop)) {
        setPreferences(m_preferences);
        return showTrouble(
            tr("Table top: '%1' is no whole number of millimetres up to %2.").arg(text, QString::number(Preferences::farthestTableTop)));
    }
    ask([&](Preferences& p) { p.tableTop = text.isEmpty() ? std::nullopt : std::optional(millimetres); });
}

QLineEdit* PreferencesView::addText(QVBoxLayout* column, const QString& name, const QString& whatItDoes, const QString& whenEmpty,
                                    int mostLetters)
{
    auto* row = new QHBoxLayout;
    row->setSpacing(12);
    QLabel* title = plainLabel(name, TextRole::Strong, this);
    setInk(title, colour::bright);
    auto* line = new TouchLine(name, whenEmpty, this);
    line->setMaxLength(mostLetters);
    row->addWidget(title);
    row->addWidget(line, 1);
    QLabel* explanation = plainLabel(whatItDoes, TextRole::Caption, this);
    setInk(explanation, colour::secondary);
    auto* both = new QVBoxLayout;
    both->setSpacing(1);
    both->addLayout(row);
    both->addWidget(explanation);
    column->addLayout(both);
    return line;
}

void PreferencesView::makeFoot(QVBoxLayout* column)
{
    auto* foot = new QHBoxLayout;
    foot->setSpacing(10);
    m_about->setAccessibleName(tr("About this software and its parts"));
    m_defaults->setAccessibleName(tr("Restore the defaults of all entries"));
    m_leave->setAccessibleName(tr("Leave the preferences"));
    foot->addWidget(m_defaults);
    foot->addStretch(1);
    foot->addWidget(m_about);
    foot->addWidget(m_leave);
    column->addLayout(foot);
    connect(m_defaults, &QPushButton::clicked, this, [this] {
        ask([](Preferences& p) {
            Preferences fresh;
            fresh.patientSide = p.patientSide; // these belong to the site: there is no default that could stand for them
            fresh.tableTop = p.tableTop;
            p = fresh;
        });
    });
    connect(m_about, &QPushButton::clicked, this, &PreferencesView::aboutRequested);
    connect(m_leave, &QPushButton::clicked, this, &PreferencesView::leaveRequested);
}

void PreferencesView::setPreferences(const Preferences& preferences)
{
    m_preferences = preferences;
    m_language->setValue(int(preferenceLanguages().indexOf(preferences.language)), languageName(preferences.language));
    m_brightness->setValue(int(preferences.brightness), word(preferences.brightness));
    m_pause->setValue(placeOf(pauses, int(preferences.audioPause.count())), tr("%1 s").arg(preferences.audioPause.count()));
    m_span->setValue(int(preferences.trendSpan), preferences.trendSpan == TrendSpan::Minute ? tr("60 s") : tr("10 min"));
    m_folder->setText(preferences.pictureFolder);
    m_patientSide->setText(preferences.patientSide);
    m_rate->setValue(placeOf(pulseRates, preferences.pulseRate), tr("%1 /s").arg(preferences.pulseRate));
    m_window->setValue(int(preferences.window), word(preferences.window));
    m_noise->setValue(placeOf(strengths, preferences.noiseReduction), tr("%1 %").arg(preferences.noiseReduction));
    m_edge->setValue(placeOf(strengths, preferences.edge), tr("%1 %").arg(preferences.edge));
    m_edgeMethod->setValue(int(preferences.edgeMethod), word(preferences.edgeMethod));
    m_hold->setValue(placeOf(holdCounts, preferences.holdPictures), holdName(preferences.holdPictures));
    m_object->setValue(placeOf(objectHeights, preferences.objectHeight), heightName(preferences.objectHeight));
    m_tableTop->setText(preferences.tableTop ? QString::number(*preferences.tableTop) : QString());
}

void PreferencesView::setReadOnly(const QString& why)
{
    m_readOnly = !why.isEmpty();
    m_state->setText(m_readOnly ? why : tr("Kept for you on this computer. Nothing here changes how the robot moves."));
    setInk(m_state, m_readOnly ? colour::bright : colour::secondary);
    for (ChoiceRow* row : {m_language, m_brightness, m_pause, m_span, m_rate, m_window, m_noise, m_edge, m_edgeMethod, m_hold, m_object})
        row->setReadOnly(m_readOnly);
    m_folder->setReadOnly(m_readOnly);
    m_patientSide->setReadOnly(m_readOnly);
    m_tableTop->setReadOnly(m_readOnly);
    m_defaults->setEnabled(!m_readOnly);
}

void PreferencesView::setOverruled(const QString& words)
{
    m_overruled->setText(words);
    m_overruled->setVisible(!words.isEmpty());
}

void PreferencesView::showTrouble(const QString& trouble)
{
    if (trouble.isEmpty())
        return setReadOnly(m_readOnly ? m_state->text() : QString());
    m_state->setText(trouble);
    setInk(m_state, colour::bright);
}

} // namespace console
