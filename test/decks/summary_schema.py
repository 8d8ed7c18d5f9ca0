"""Summaries are what doc/summary.schema.json says: of linear jobs, histories, combinations, refined jobs, bonded bodies, errors"""
import glob
import json
import os

from support import HERE, Test, input_deck, read_text, write

SCHEMA = os.path.join(HERE, '..', '..', 'doc', 'summary.schema.json')
DECKS = (('inputs', 'first.dat'), ('inputs', 'chimney.dat'), ('inputs', 'monopile.dat'),
         ('inputs/hard', 'ground_stress.dat'), ('inputs/gallery', 'lined_shaft.dat'), ('test/decks/good', 'yield_column.dat'),
         ('test/decks/bad', 'keep_all_number.dat'))
KINDS = {'null': type(None), 'boolean': bool, 'integer': int, 'number': (int, float), 'string': str, 'array': list,
         'object': dict}


def is_kind(value, kind):
    """Whether a value is of a kind; true and false are no numbers"""
    return isinstance(value, KINDS[kind]) and (kind == 'boolean' or not isinstance(value, bool))


def faults_of(value, schema, place='summary'):
    """Where a value is not what a schema says: type, enum, properties, required, items, if and then"""
    kinds = schema.get('type')
    kinds = [kinds] if isinstance(kinds, str) else kinds
    if kinds and not any(is_kind(value, kind) for kind in kinds):
        return [f'{place}: {value!r} is not {" or ".join(kinds)}']
    if 'enum' in schema and value not in schema['enum']:
        return [f'{place}: {value!r} is none of {schema["enum"]}']
    found = []
    if isinstance(value, list):
        for k, one in enumerate(value):
            found += faults_of(one, schema.get('items', {}), f'{place}[{k}]')
    if isinstance(value, dict):
        required = list(schema.get('required', ()))
        if 'if' in schema and not faults_of(value, schema['if']):
            required += schema['then']['required']
        found += [f'{place}: {key} is missing' for key in required if key not in value]
        properties = schema.get('properties', {})
        for key, one in value.items():
            if key in properties:
                found += faults_of(one, properties[key], f'{place}.{key}')
            elif schema.get('additionalProperties', True) is False:
                found.append(f'{place}: {key} is not in the schema')
    return found


def summaries(program, folder):
    """Faults of the summaries of some runs"""
    schema = json.loads(read_text(SCHEMA))
    for where, name in DECKS:
        program.run('run', os.path.join(HERE, '..', '..', where, name), '-o', '.', folder=folder)
    refined = write(folder, 'refined.dat', input_deck('first.dat').replace('\nEND', '\nERROR\n       1.0\nEND'))
    program.run('run', refined, '-o', '.', folder=folder)
    paths = sorted(glob.glob(os.path.join(folder, '*.json')))
    keys = set().union(*(json.loads(read_text(path)) for path in paths))
    found = [f'no summary has {key}' for key in schema['properties'] if key not in keys]
    found += [f'{os.path.basename(path)}: {fault}' for path in paths
             for fault in faults_of(json.loads(read_text(path)), schema)]
    return found + ([] if len(paths) > len(DECKS) + 1 else [f'found {len(paths)} summaries'])


def schema_judges(_program, _folder):
    """The judge itself finds a key that is missing, a wrong kind, a key too many"""
    schema = json.loads(read_text(SCHEMA))
    bad = faults_of({'program': 'axijoint', 'exit_code': True, 'other': 1}, schema)
    wanted = ('version is missing', 'exit_code: True is not integer', 'other is not in the schema')
    return [f'expected {text}' for text in wanted if not any(text in fault for fault in bad)]


def tests(_program):
    """Both tests"""
    return [Test('summary/schema', lambda folder: summaries(_program, folder)),
            Test('summary/schema judges', lambda folder: schema_judges(_program, folder))]
