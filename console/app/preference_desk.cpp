// From the file to the screen and back.
#include "app/preference_desk.hpp"

#include "app/picture_desk.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/preferences_view.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QDateTime>

namespace console {

PreferenceDesk::PreferenceDesk(const Options& options, ConsoleModels& models, PictureDesk& pictures, QObject* parent)
    : QObject(parent), m_options(options), m_models(models), m_pictures(pictures), m_store(options.preferences)
{}

void PreferenceDesk::build(CockpitWindow& window)
{
    m_window = &window;
    m_view = new PreferencesView;
    window.addView(View::Preferences, m_view);
    connect(m_view, &PreferencesView::changed, this, &PreferenceDesk::change);
    connect(m_view, &PreferencesView::leaveRequested, &window, [&window] { window.showView(View::Cockpit); });
    connect(m_view, &PreferencesView::aboutRequested, &window, [&window] { window.showView(View::About); });
    connect(&m_models.permit, &PermitModel::phaseChanged, this, &PreferenceDesk::followPermit);
    m_view->setOverruled(overruled());
    followPermit();
    if (kept())
        read();
    apply();
}

void PreferenceDesk::read()
{
    const auto reading = m_store.read();
    m_preferences = reading.preferences;
    for (const QString& trouble : reading.troubles)
        note(trouble);
    if (!reading.troubles.isEmpty())
        m_view->showTrouble(reading.troubles.join(QLatin1Char(' ')));
}

void PreferenceDesk::change(const Preferences& wanted)
{
    if (!preferencesMayChange(m_models.permit.phase()))
        return m_view->setPreferences(m_preferences);
    m_preferences = withinBounds(wanted);
    apply();
    const QString trouble = kept() ? m_store.write(m_preferences) : QString();
    if (!trouble.isEmpty())
        note(trouble);
    m_view->showTrouble(trouble);
}

/// Only what differs: what a person changed meanwhile by the controls themselves stays.
void PreferenceDesk::apply()
{
    const Preferences& p = m_preferences;
    m_models.alarms.setAudioPause(p.audioPause);
    if (p.brightness != theme::brightness())
        theme::setBrightness(*qApp, p.brightness);
    if (p.trendSpan != m_inForce.trendSpan)
        m_window->setTrendSpan(p.trendSpan);
    m_models.xray.setRequestedRate(p.pulseRate);
    m_models.patientSide = p.patientSide;
    m_pictures.setHoldPictures(p.holdPictures);
    if (m_options.pictures.isEmpty())
        m_pictures.setFolder(p.pictureFolder);
    DisplaySettings shown = m_pictures.display().settings();
    if (p.window != m_inForce.window)
        shown.window = p.window;
    if (p.noiseReduction != m_inForce.noiseReduction)
        shown.noiseReduction = p.noiseReduction;
    if (p.edge != m_inForce.edge)
        shown.edge = p.edge;
    if (p.edgeMethod != m_inForce.edgeMethod)
        shown.edgeMethod = p.edgeMethod;
    m_pictures.display().set(shown);
    m_pictures.display().setTable(p.tableTop, p.objectHeight);
    m_inForce = p;
    m_view->setPreferences(p);
}

void PreferenceDesk::followPermit()
{
    const PermitPhase phase = m_models.permit.phase();
    m_view->setReadOnly(
        preferencesMayChange(phase)
            ? QString()
            : tr("Read only: the permit is %1. Preferences can be changed when nothing is armed or in hold.").arg(word(phase)));
}

QString PreferenceDesk::overruled() const
{
    if (!kept())
        return tr("This run has no file of preferences: it begins with the defaults, and changes are not kept.");
    return m_options.pictures.isEmpty()
               ? QString()
               : tr("For this run the command line decides on the folder of pictures: %1.").arg(m_options.pictures);
}

void PreferenceDesk::note(const QString& trouble) { m_models.log.append(LogKind::Trouble, trouble, QDateTime::currentMSecsSinceEpoch()); }

} // namespace console
