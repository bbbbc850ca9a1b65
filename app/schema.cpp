#include "scene/schema.h"

#include "app/command_line.h"
#include "app/output.h"
#include "app/verbs.h"

namespace etalon {

void addSchema(Verb& command) {
    Verb& verb = command.addVerb("schema", "Print the keys of scene files as Markdown tables");
    verb.onRun([] {
        printOut(schemaText());
        return ExitCode::done;
    });
}

}  // namespace etalon
